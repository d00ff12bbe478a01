#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "lascaux/io/read_mesh.h"
#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/stability.h"
#include "lascaux/volume/wall_thickness.h"

/// Any bytes give a mesh that can be measured, or an error of the input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Small limits, so that what grows without bound meets them within a fuzzer's patience.
  constexpr lascaux::ReadMeshOptions kOptions{.max_triangles = 20'000,
                                              .max_unpacked = std::size_t{1} << 22};
  const auto outcome = lascaux::ReadMesh({reinterpret_cast<const char*>(data), size}, kOptions);
  if (!outcome) {
    if (outcome.diagnostics().front().failure != lascaux::FailureKind::kInput) std::abort();
    return 0;
  }
  const lascaux::Mesh& mesh = outcome->mesh;
  if (!outcome->details.triangle_parts.empty() &&
      outcome->details.triangle_parts.size() != mesh.triangles.size())
    std::abort();
  static_cast<void>(lascaux::CheckMesh(mesh));
  static_cast<void>(lascaux::SmallestWall(mesh));
  static_cast<void>(lascaux::MeasureStability(mesh, 0.3));
  return 0;
}

#include "lascaux/io/write_stl.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "io/file_writer.h"
#include "io/scene_vertices.h"

namespace lascaux {
namespace {

static_assert(std::endian::native == std::endian::little,
              "STL is little endian, as is memory here");

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kRecordBytes = 50;  // normal, three corners, two bytes of attributes
constexpr std::size_t kBatch = 16384;  // triangles at once: 0.8 MB stay in the second-level cache

/// Float coordinates of millimetre-sized models differ by few bits on small faces: the cross
/// product needs double.
Eigen::Vector3f Normal(const std::array<Eigen::Vector3f, 3>& corners) {
  const Eigen::Vector3d a = corners[0].cast<double>();
  const Eigen::Vector3d n = (corners[1].cast<double>() - a).cross(corners[2].cast<double>() - a);
  const double length = n.norm();
  if (!(length > 0)) return Eigen::Vector3f::Zero();
  return (n / length).cast<float>();
}

void Encode(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle, char* record) {
  std::array<Eigen::Vector3f, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = ToPrintFrame(mesh.vertices[triangle[i]]);
  const Eigen::Vector3f normal = Normal(corners);
  std::memcpy(record, normal.data(), 12);
  for (std::size_t i = 0; i < 3; ++i) std::memcpy(record + 12 + 12 * i, corners[i].data(), 12);
  std::memset(record + 48, 0, 2);
}

}  // namespace

Diagnostics WriteStl(const std::filesystem::path& path, const Mesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    return {Error(FailureKind::kOutput, "cannot-write",
                  fmt::format("cannot write '{}': STL holds at most 4294967295 triangles, {} are "
                              "wanted; lower the resolution",
                              path.string(), count))};
  }
  FileWriter file(path);
  std::string header = "lascaux binary STL, unit millimetre, Z up";
  header.resize(kHeaderBytes, ' ');
  const auto count32 = static_cast<std::uint32_t>(count);
  header.append(reinterpret_cast<const char*>(&count32), sizeof count32);
  file.Write(header);

  std::vector<char> buffer(std::min(count, kBatch) * kRecordBytes);
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    const std::size_t batch = std::min(kBatch, count - begin);
    for (std::size_t i = 0; i < batch; ++i) {
      Encode(mesh, mesh.triangles[begin + i], buffer.data() + i * kRecordBytes);
    }
    file.Write({buffer.data(), batch * kRecordBytes});
  }
  return file.Close();
}

}  // namespace lascaux

#include "io/vdb_conventions.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "lascaux/io/content_hash.h"
#include "lascaux/volume/narrow_band.h"

namespace lascaux {
namespace {

/// Maps whose determinant is below this are refused by OpenVDB: three times its Tolerance<double>.
constexpr double kSmallestDeterminant = 3e-15;

// Where the id stands in a file: after the magic number, the versions and the flag for offsets.
constexpr std::size_t kIdOffset = 21, kIdLength = 36;

}  // namespace

float VdbBackground(double voxel_size) {
  auto background = static_cast<float>(kBandVoxels * voxel_size);
  while (static_cast<double>(background) / voxel_size < kBandVoxels)
    background = std::nextafter(background, std::numeric_limits<float>::infinity());
  return background;
}

void SetVdbId(std::string& bytes, std::string_view hashes_behind) {
  bytes.replace(kIdOffset, kIdLength, kIdLength, '0');
  std::string id = ContentHashText(bytes);
  if (!hashes_behind.empty()) id = ContentHashText(id.append(hashes_behind));
  for (const unsigned dash : {8U, 13U, 18U, 23U}) id.insert(dash, 1, '-');
  bytes.replace(kIdOffset, kIdLength, id);
}

Diagnostics CheckVdbVoxelSize(const std::filesystem::path& path, double voxel_size, Unit unit) {
  // OpenVDB scales first and multiplies the three sides then: the limit is taken a hair wider than
  // it does.
  if (std::pow(voxel_size * PerMillimetre(unit), 3) >= kSmallestDeterminant * (1 + 1e-9)) return {};
  return {Error(FailureKind::kOutput, "voxel-too-small",
                fmt::format("cannot write '{}': OpenVDB refuses voxels of {:.3g} mm in units of {} "
                            "(least {:.3g} mm); use --units mm, a larger --size or a lower "
                            "--resolution",
                            path.string(), voxel_size, Name(unit),
                            std::cbrt(kSmallestDeterminant) / PerMillimetre(unit)))};
}

}  // namespace lascaux

#include "lascaux/volume/up_axis.h"

#include <cstddef>

namespace lascaux {
namespace {

constexpr int kLast = kBlockSide - 1;

/// Voxel (x, y, z) becomes (x, -1 - z, y): the 1 keeps blocks at multiples of their side.
Eigen::Vector3i TurnedCorner(const Eigen::Vector3i& lowest, int side) {
  return {lowest.x(), -lowest.z() - side, lowest.y()};
}

/// Place of the turned block's voxel (x, y, z) in the block as it was.
constexpr std::size_t Source(int x, int y, int z) {
  return static_cast<std::size_t>(64 * x + 8 * z + (kLast - y));
}

VoxelMask Turned(const VoxelMask& mask) {
  VoxelMask turned = {};
  for (std::size_t x = 0; x < mask.size(); ++x)
    for (int y = 0; y < kBlockSide; ++y)
      for (int z = 0; z < kBlockSide; ++z)
        turned[x] |= (mask[x] >> Source(0, y, z) & 1) << (8 * y + z);
  return turned;
}

}  // namespace

NarrowBand TurnedZUp(const NarrowBand& band) {
  NarrowBand turned;
  turned.voxel_size = band.voxel_size;
  turned.origin = {band.origin.x(), band.voxel_size - band.origin.z(), band.origin.y()};
  turned.background = band.background;
  for (const Eigen::Vector3i& block : band.blocks)
    turned.blocks.push_back(TurnedCorner(block, kBlockSide));
  turned.values.resize(band.values.size());
  float* to = turned.values.data();
  for (std::size_t b = 0; b < band.size(); ++b) {
    const float* const from = band.values.data() + kBlockVoxels * b;
    for (int x = 0; x < kBlockSide; ++x)
      for (int y = 0; y < kBlockSide; ++y)
        for (int z = 0; z < kBlockSide; ++z) *to++ = from[Source(x, y, z)];
    turned.active.push_back(Turned(band.active[b]));
  }
  for (const Cube& cube : band.inside)
    turned.inside.push_back({TurnedCorner(cube.origin, cube.side), cube.side});
  return turned;
}

}  // namespace lascaux

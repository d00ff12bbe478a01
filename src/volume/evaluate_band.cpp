#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "volume/band.h"
#include "volume/block_samples.h"

namespace lascaux {
namespace {

// A voxel next to the surface is at most one voxel from it; the first-order distance errs by a few
// percent there.
constexpr float kRefineVoxels = 1.25F;

/// The voxels of a mask, ascending.
struct ChosenVoxels {
  std::array<std::uint16_t, kBlockVoxels> voxel;
  std::size_t count = 0;

  explicit ChosenVoxels(const VoxelMask& mask) {
    for (std::size_t x = 0; x < 8; ++x) {
      for (std::uint64_t word = mask[x]; word != 0; word &= word - 1)
        voxel[count++] =
            static_cast<std::uint16_t>(64 * x + static_cast<std::size_t>(std::countr_zero(word)));
    }
  }
};

/// A block's part of a band.
struct BlockPart {
  const VoxelMask& inside;
  std::span<float> distance;
};

/// Measures the distances of a block's crossings.
class CrossingMeter {
 public:
  explicit CrossingMeter(const BandSource& source) : source_(source), offsets_(source.voxel_size) {}

  void Run(const Block& block, const VoxelMask& crossings, const BlockPart& out) const {
    const ChosenVoxels chosen(crossings);
    if (chosen.count == 0) return;
    const Eigen::Vector3d center = BlockCenter(block, source_.voxel_size);
    const auto h = static_cast<float>(source_.voxel_size);
    Samples first, foot;
    for (std::size_t k = 0; k < chosen.count; ++k) {
      const std::size_t i = chosen.voxel[k];
      first.x[k] = offsets_.x[i];
      first.y[k] = offsets_.y[i];
      first.z[k] = offsets_.z[i];
    }
    first.Evaluate(source_.field, block, center, chosen.count, kFar * h);
    // From the foot of the perpendicular: what is left to the surface there is second-order small.
    std::array<std::uint16_t, kBlockVoxels> near;
    std::size_t count = 0;
    for (std::size_t k = 0; k < chosen.count; ++k) {
      const float d = first.distance[k];
      out.distance[chosen.voxel[k]] = std::min(std::abs(d) / h, kFar);
      if (!(std::abs(d) < kRefineVoxels * h)) continue;
      // F falls outward, so the gradient points to the inside.
      const Eigen::Vector3f way = d * first.Gradient(k).normalized();
      foot.x[count] = first.x[k] + way.x();
      foot.y[count] = first.y[k] + way.y();
      foot.z[count] = first.z[k] + way.z();
      near[count++] = static_cast<std::uint16_t>(k);
    }
    if (count == 0) return;
    foot.Evaluate(source_.field, block, center, count, kFar * h);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t k = near[n], i = chosen.voxel[k];
      const bool is_inside = (out.inside[i / 64] >> i % 64 & 1) != 0;
      const float d = first.distance[k] + foot.distance[n];
      out.distance[i] = std::clamp((is_inside ? -d : d) / h, 0.0F, kFar);
    }
  }

 private:
  const BandSource& source_;
  BlockOffsets offsets_;
};

VoxelMask InsideOf(const BandSource& source, const Block& block) {
  if (!block.inside)
    return source.field.FindInside({BlockCenter(block, source.voxel_size), source.voxel_size},
                                   block.active);
  VoxelMask inside{};
  if (*block.inside) inside.fill(~std::uint64_t{0});
  return inside;
}

}  // namespace

Band FindInside(const BandSource& source, const Execution& execution) {
  const std::vector<Block>& blocks = source.blocks;
  Band band;
  band.origins.reserve(blocks.size());
  for (const Block& block : blocks) band.origins.push_back(block.origin);
  band.inside.resize(blocks.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    if (!execution.IsCancelled()) band.inside[b] = InsideOf(source, blocks[b]);
  });
  return band;
}

void MeasureCrossings(const BandSource& source, const std::vector<VoxelMask>& crossings, Band& band,
                      const Execution& execution) {
  band.distance.resize(kBlockVoxels * band.size());
  const CrossingMeter meter(source);
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    const std::span distance = std::span(band.distance).subspan(kBlockVoxels * b, kBlockVoxels);
    std::fill(distance.begin(), distance.end(), kFar);
    if (execution.IsCancelled()) return;
    meter.Run(source.blocks[b], crossings[b], {band.inside[b], distance});
  });
}

void ConnectBlocks(Band& band) {
  const BlockMap map(band.origins);
  band.neighbours.resize(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    for (std::size_t side = 0; side < 6; ++side) {
      Eigen::Vector3i origin = band.origins[b];
      origin[static_cast<int>(side / 2)] += side % 2 == 0 ? -kBlockSide : kBlockSide;
      band.neighbours[b][side] = map.Find(origin);
    }
  });
}

std::vector<VoxelMask> FindCrossings(const Band& band) {
  constexpr std::uint64_t kFirstZ = 0x0101010101010101;  // the bits with z = 0
  constexpr std::uint64_t kLastZ = kFirstZ << 7;
  std::vector<VoxelMask> crossings(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    const VoxelMask& own = band.inside[b];
    // A missing neighbour has no surface near, so it is on the same side as the voxels that touch
    // it: its words may be taken for the block's own, shifted back.
    const auto neighbour = [&](std::size_t side) {
      const std::int32_t n = band.neighbours[b][side];
      return n == kNoBlock ? nullptr : &band.inside[static_cast<std::size_t>(n)];
    };
    const bool mirrors = band.upper_half && band.origins[b].z() == 0;
    for (std::size_t x = 0; x < 8; ++x) {
      const std::uint64_t w = own[x];
      const auto beside = [&](std::size_t side) {
        const VoxelMask* const n = neighbour(side);
        return n == nullptr ? std::nullopt : std::optional((*n)[x]);
      };
      const std::uint64_t low_x = x > 0 ? own[x - 1] : neighbour(0) ? (*neighbour(0))[7] : w;
      const std::uint64_t high_x = x < 7 ? own[x + 1] : neighbour(1) ? (*neighbour(1))[0] : w;
      const std::uint64_t low_y = w << 8 | (beside(2) ? *beside(2) >> 56 : w & 0xFF);
      const std::uint64_t high_y = w >> 8 | (beside(3) ? *beside(3) << 56 : w & 0xFFULL << 56);
      std::uint64_t first_z = w & kFirstZ;
      if (mirrors) {
        first_z = w >> 1 & kFirstZ;
      } else if (beside(4)) {
        first_z = *beside(4) >> 7 & kFirstZ;
      }
      const std::uint64_t last_z = beside(5) ? *beside(5) << 7 & kLastZ : w & kLastZ;
      const std::uint64_t low_z = (w << 1 & ~kFirstZ) | first_z;
      const std::uint64_t high_z = (w >> 1 & ~kLastZ) | last_z;
      crossings[b][x] =
          (w ^ low_x) | (w ^ high_x) | (w ^ low_y) | (w ^ high_y) | (w ^ low_z) | (w ^ high_z);
    }
  });
  return crossings;
}

}  // namespace lascaux

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "volume/band.h"
#include "volume/block_samples.h"
#include "volume/side_words.h"

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
  std::vector<VoxelMask> crossings(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    for (std::size_t x = 0; x < 8; ++x) {
      const auto sides = CrossedSides(band, b, x);
      crossings[b][x] = sides[0] | sides[1] | sides[2] | sides[3] | sides[4] | sides[5];
    }
  });
  return crossings;
}

}  // namespace lascaux

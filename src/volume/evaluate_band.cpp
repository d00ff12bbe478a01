#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "volume/band.h"
#include "volume/block_samples.h"

namespace lascaux {
namespace {

// A voxel next to the surface is at most one voxel from it; the first-order distance errs by a few
// percent there.
constexpr float kRefineVoxels = 1.25F;

/// Evaluates one block at a time.
class BlockEvaluator {
 public:
  explicit BlockEvaluator(const BandSource& source)
      : source_(source), offsets_(source.voxel_size) {}

  void Run(const Block& block, VoxelMask& inside, std::span<float> distance) const {
    const Eigen::Vector3d center = BlockCenter(block, source_.voxel_size);
    const auto limit = static_cast<float>(static_cast<double>(kFar) * source_.voxel_size);
    const auto to_voxels = static_cast<float>(1 / source_.voxel_size);
    Samples first;
    first.x = offsets_.x;
    first.y = offsets_.y;
    first.z = offsets_.z;
    first.Evaluate(source_.field, block, center, kBlockVoxels, limit);

    const float near = kRefineVoxels / to_voxels;
    std::array<std::uint16_t, kBlockVoxels> refined;
    std::size_t count = 0;
    inside.fill(0);
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      const float d = first.distance[i];
      distance[i] = std::abs(d) * to_voxels;
      const bool is_inside = first.value[i] > static_cast<float>(kIsoValue);
      inside[i / 64] |= static_cast<std::uint64_t>(is_inside) << i % 64;
      refined[count] = static_cast<std::uint16_t>(i);
      count += std::abs(d) < near ? 1 : 0;
    }
    if (count == 0) return;

    // From the foot of the perpendicular: what is left to the surface there is second-order small.
    Samples foot;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = refined[k];
      // F falls outward, so the gradient points to the inside.
      const Eigen::Vector3f way = first.distance[i] * first.Gradient(i).normalized();
      foot.x[k] = offsets_.x[i] + way.x();
      foot.y[k] = offsets_.y[i] + way.y();
      foot.z[k] = offsets_.z[i] + way.z();
    }
    foot.Evaluate(source_.field, block, center, count, limit);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = refined[k];
      const bool is_inside = (inside[i / 64] >> i % 64 & 1) != 0;
      const float d = first.distance[i] + foot.distance[k];
      distance[i] = std::clamp((is_inside ? -d : d) * to_voxels, 0.0F, kFar);
    }
  }

 private:
  const BandSource& source_;
  BlockOffsets offsets_;
};

}  // namespace

Band EvaluateBand(const BandSource& source, const Execution& execution) {
  const std::vector<Block>& blocks = source.blocks;
  Band band;
  band.origins.reserve(blocks.size());
  for (const Block& block : blocks) band.origins.push_back(block.origin);
  band.inside.resize(blocks.size());
  band.distance.resize(kBlockVoxels * blocks.size());
  const BlockEvaluator evaluator(source);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    if (execution.IsCancelled()) return;
    evaluator.Run(blocks[b], band.inside[b],
                  std::span(band.distance).subspan(kBlockVoxels * b, kBlockVoxels));
  });
  return band;
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

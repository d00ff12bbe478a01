#include "volume/find_blocks.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace lascaux {
namespace {

using Eigen::Vector3i;

constexpr int kRootSide = 64;

/// One root cube at a time; keeps the lists of each level to save allocations.
class Descent {
 public:
  Descent(const CompiledField& field, const BlockSearch& search) : field_(field), search_(search) {}

  FoundBlocks Run(const Vector3i& root, const ActiveSet& all) {
    found_ = {};
    Visit({root, kRootSide}, all, 0);
    return std::move(found_);
  }

 private:
  void Visit(const Cube& cube, const ActiveSet& around, std::size_t level) {
    const double half = 0.5 * (cube.side - 1);
    const Eigen::Vector3d corner(cube.origin.x(), cube.origin.y(), cube.origin.z());
    const double radius = std::sqrt(3.0) * half + search_.margin;
    BallBounds found = field_.BoundOnBall(
        {search_.voxel_size * (corner.array() + half), search_.voxel_size * radius}, around,
        std::move(lists_[level]));
    if (static_cast<double>(found.bounds.lower) > kIsoValue) {
      found_.inside.push_back(cube);
    } else if (static_cast<double>(found.bounds.upper) >= kIsoValue) {
      if (cube.side == kBlockSide) {
        found_.blocks.push_back({cube.origin, found.active, SideOf(cube, found.active)});
      } else {
        const int side = cube.side / 2;
        for (int child = 0; child < 8; ++child) {
          const Vector3i shift(child >> 2 & 1, child >> 1 & 1, child & 1);
          Visit({cube.origin + side * shift, side}, found.active, level + 1);
        }
      }
    }
    lists_[level] = std::move(found.active);
  }

  /// The side that all voxels of a block are on, by bounds on the block without its surroundings.
  std::optional<bool> SideOf(const Cube& block, const ActiveSet& active) {
    constexpr double kHalf = 0.5 * (kBlockSide - 1);
    constexpr double kSlack = 1.001;  // the voxels' places are rounded
    const Eigen::Vector3d corner = block.origin.cast<double>();
    BallBounds found = field_.BoundOnBall({search_.voxel_size * (corner.array() + kHalf),
                                           search_.voxel_size * kSlack * std::sqrt(3.0) * kHalf},
                                          active, std::move(inner_));
    inner_ = std::move(found.active);
    if (static_cast<double>(found.bounds.lower) > kIsoValue) return true;
    if (static_cast<double>(found.bounds.upper) < kIsoValue) return false;
    return std::nullopt;
  }

  const CompiledField& field_;
  const BlockSearch& search_;
  FoundBlocks found_;
  ActiveSet inner_;
  std::array<ActiveSet, 4> lists_;
};

int RootIndex(double voxel) { return static_cast<int>(std::floor(voxel / kRootSide)); }

}  // namespace

FoundBlocks FindBlocks(const CompiledField& field, const BlockSearch& search,
                       const Execution& execution) {
  const Eigen::AlignedBox3d& box = field.bounds();
  std::vector<Vector3i> roots;
  if (!box.isEmpty()) {
    std::array<int, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      low[i] = RootIndex(box.min()[axis] / search.voxel_size - search.margin);
      high[i] = RootIndex(box.max()[axis] / search.voxel_size + search.margin);
    }
    if (search.upper_half) low[2] = std::max(low[2], 0);
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) {
          roots.emplace_back(kRootSide * x, kRootSide * y, kRootSide * z);
        }
      }
    }
  }
  const ActiveSet all = field.All();
  std::vector<FoundBlocks> found(roots.size());
  tbb::parallel_for(std::size_t{0}, roots.size(), [&](std::size_t i) {
    if (!execution.IsCancelled()) found[i] = Descent(field, search).Run(roots[i], all);
  });
  FoundBlocks together;
  for (FoundBlocks& one : found) {
    std::move(one.blocks.begin(), one.blocks.end(), std::back_inserter(together.blocks));
    together.inside.insert(together.inside.end(), one.inside.begin(), one.inside.end());
  }
  return together;
}

}  // namespace lascaux

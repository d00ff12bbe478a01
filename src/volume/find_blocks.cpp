#include "volume/find_blocks.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstddef>
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
    const double half = 0.5 * (kRootSide - 1);
    BallBounds bounds = field_.BoundOnBall(
        {search_.voxel_size * (root.cast<double>().array() + half), BallOf(kRootSide)}, all,
        std::move(lists_[0]));
    lists_[0] = std::move(bounds.active);
    Add({root, kRootSide}, bounds.bounds, 0);
    return std::move(found_);
  }

 private:
  /// Radius of the ball around a cube's voxels and what is near to them.
  double BallOf(int side) const {
    return search_.voxel_size * (std::sqrt(3.0) * 0.5 * (side - 1) + search_.margin);
  }

  /// Keeps or opens a cube that has these bounds and the list of its level.
  void Add(const Cube& cube, const FieldBounds& bounds, std::size_t level) {
    if (static_cast<double>(bounds.lower) > kIsoValue) {
      found_.inside.push_back(cube);
    } else if (static_cast<double>(bounds.upper) >= kIsoValue) {
      Open(cube, level);
    }
  }

  void Open(const Cube& cube, std::size_t level) {
    const int side = cube.side / 2;
    const bool has_blocks = side == kBlockSide;
    constexpr double kSlack = 1.001;  // the voxels' places are rounded
    const BallsAround balls{
        search_.voxel_size * (cube.origin.cast<double>().array() + 0.5 * (cube.side - 1)),
        search_.voxel_size * 0.5 * side, BallOf(side),
        has_blocks ? search_.voxel_size * kSlack * std::sqrt(3.0) * 0.5 * (kBlockSide - 1) : 0};
    BoundsAround around = field_.BoundOnBalls(balls, lists_[level], std::move(around_[level]));
    for (std::size_t child = 0; child < around.bounds.size(); ++child) {
      const Vector3i shift(child >> 2 & 1, child >> 1 & 1, child & 1);
      const Cube eighth{cube.origin + side * shift, side};
      const FieldBounds& bounds = around.bounds[child];
      const bool is_open = IsOpen(bounds);
      if (is_open && has_blocks) {
        found_.blocks.push_back({eighth.origin, around.Active(child), SideOf(around.inner[child])});
        continue;
      }
      if (is_open) lists_[level + 1] = around.Active(child, std::move(lists_[level + 1]));
      Add(eighth, bounds, level + 1);
    }
    around_[level] = std::move(around);
  }

  static bool IsOpen(const FieldBounds& bounds) {
    return static_cast<double>(bounds.lower) <= kIsoValue &&
           static_cast<double>(bounds.upper) >= kIsoValue;
  }

  /// The side that all voxels of a block are on, by bounds on the block without its surroundings.
  static std::optional<bool> SideOf(const FieldBounds& bounds) {
    if (IsOpen(bounds)) return std::nullopt;
    return static_cast<double>(bounds.lower) > kIsoValue;
  }

  const CompiledField& field_;
  const BlockSearch& search_;
  FoundBlocks found_;
  std::array<ActiveSet, 3> lists_;
  std::array<BoundsAround, 3> around_;
};

/// Of all roots, in their order.
FoundBlocks Together(std::vector<FoundBlocks>& found) {
  FoundBlocks together;
  std::vector<std::size_t> first;
  std::size_t blocks = 0, inside = 0;
  for (const FoundBlocks& one : found) {
    first.push_back(blocks);
    blocks += one.blocks.size();
    inside += one.inside.size();
  }
  together.inside.reserve(inside);
  for (const FoundBlocks& one : found)
    together.inside.insert(together.inside.end(), one.inside.begin(), one.inside.end());
  together.blocks.resize(blocks);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    std::move(found[i].blocks.begin(), found[i].blocks.end(),
              together.blocks.begin() + static_cast<std::ptrdiff_t>(first[i]));
    found[i].blocks = {};
  });
  return together;
}

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
  return Together(found);
}

}  // namespace lascaux

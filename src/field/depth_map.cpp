#include "lascaux/field/depth_map.h"

#include <algorithm>
#include <limits>

#include "bicubic.h"

namespace lascaux {
namespace {

using internal::Floor;

std::size_t IndexOf(const DepthMap& map, int column, int row) {
  const int c = std::clamp(column, 0, map.columns - 1), r = std::clamp(row, 0, map.rows - 1);
  return static_cast<std::size_t>(r) * static_cast<std::size_t>(map.columns) +
         static_cast<std::size_t>(c);
}

/// In cells, kept within two of the table: further out nothing changes, and a cast would overflow.
Eigen::Vector2d InCells(const DepthMap& map, const Eigen::Vector2d& place) {
  const Eigen::Vector2d most(map.columns + 1, map.rows + 1);
  return ((place - map.origin) / map.cell).cwiseMax(-2).cwiseMin(most);
}

}  // namespace

DepthSample EvaluateDepth(const DepthMap& map, const Eigen::Vector2d& place) {
  const auto both = internal::EvaluateSplines<2>(InCells(map, place), [&map](int column, int row) {
    const std::size_t i = IndexOf(map, column, row);
    return Eigen::Array2d(static_cast<double>(map.middle[i]),
                          static_cast<double>(map.steepness[i]));
  });
  const Eigen::Array2d by_x = both.by_x / map.cell, by_y = both.by_y / map.cell;
  return {both.value[0], both.value[1], {by_x[0], by_y[0]}, {by_x[1], by_y[1]}};
}

DepthRange RangeOf(const DepthMap& map, const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d low = InCells(map, box.min()), high = InCells(map, box.max());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  DepthRange range{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (int row = Floor(low.y()) - 1; row <= Floor(high.y()) + 2; ++row) {
    for (int column = Floor(low.x()) - 1; column <= Floor(high.x()) + 2; ++column) {
      const std::size_t i = IndexOf(map, column, row);
      const auto middle = static_cast<double>(map.middle[i]);
      const auto steepness = static_cast<double>(map.steepness[i]);
      range.middle_low = std::min(range.middle_low, middle);
      range.middle_high = std::max(range.middle_high, middle);
      range.steepness_low = std::min(range.steepness_low, steepness);
      range.steepness_high = std::max(range.steepness_high, steepness);
    }
  }
  return range;
}

}  // namespace lascaux

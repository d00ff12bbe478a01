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
  const Eigen::Vector2d at = InCells(map, place);
  const internal::SplineSample middle = internal::EvaluateSpline(
      at, [&map](int column, int row) { return map.middle[IndexOf(map, column, row)]; });
  const internal::SplineSample steepness = internal::EvaluateSpline(
      at, [&map](int column, int row) { return map.steepness[IndexOf(map, column, row)]; });
  return {middle.value, steepness.value, middle.slope / map.cell, steepness.slope / map.cell};
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

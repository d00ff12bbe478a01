#include "spline_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bicubic.h"

namespace lascaux::internal {
namespace {

constexpr int kBefore = kTableReach + 1, kBehind = kTableReach + 3;

std::size_t IndexOf(const DepthMap& map, int column, int row) {
  const int c = std::clamp(column, 0, map.columns - 1), r = std::clamp(row, 0, map.rows - 1);
  return static_cast<std::size_t>(r) * static_cast<std::size_t>(map.columns) +
         static_cast<std::size_t>(c);
}

}  // namespace

template <typename At>
void SplineTable::Fill(const Shape& shape, const At& at) {
  shape_ = shape;
  stride_ = shape.channels * (kBefore + shape.columns + kBehind);
  coefficients_.reserve(static_cast<std::size_t>(stride_) *
                        static_cast<std::size_t>(kBefore + shape.rows + kBehind));
  for (int row = -kBefore; row < shape.rows + kBehind; ++row) {
    for (int column = -kBefore; column < shape.columns + kBehind; ++column) {
      const auto here = at(column, row);
      coefficients_.insert(coefficients_.end(), here.begin(), here.end());
    }
  }
}

SplineTable::SplineTable(const DepthMap& map) : origin_(map.origin), cell_(map.cell) {
  Fill({2, map.columns, map.rows}, [&map](int column, int row) {
    const std::size_t i = IndexOf(map, column, row);
    return std::array{map.middle[i], map.steepness[i]};
  });
}

SplineTable::SplineTable(const PlanarGain& gain) : origin_(gain.origin), cell_(gain.cell) {
  Fill({1, gain.columns, gain.rows},
       [&gain](int column, int row) { return std::array{gain.At(column, row)}; });
}

KernelTable SplineTable::From(const Eigen::Vector2d& origin) const {
  constexpr double kFarAway = 1e8;  // cells: fits into an integer
  const Eigen::Vector2d cells = ((origin - origin_) / cell_).cwiseMax(-kFarAway).cwiseMin(kFarAway);
  const int column = Floor(cells.x()), row = Floor(cells.y());
  return {coefficients_.data(),
          shape_.channels,
          shape_.columns,
          shape_.rows,
          stride_,
          column,
          row,
          static_cast<float>(cells.x() - column),
          static_cast<float>(cells.y() - row),
          static_cast<float>(1 / cell_),
          0.0F};
}

Eigen::Vector2d SplineTable::InCells(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d most(shape_.columns + 1, shape_.rows + 1);
  return ((place - origin_) / cell_).cwiseMax(-kTableReach).cwiseMin(most);
}

SplineTable::Extent SplineTable::ExtentOn(const Eigen::AlignedBox2d& box,
                                          const BlockKernel& kernel) const {
  const Eigen::Vector2d low = InCells(box.min()), high = InCells(box.max());
  const int column = Floor(low.x()) - 1, row = Floor(low.y()) - 1;
  Extent extent;
  kernel.extent(From(origin_),
                {column, row, Floor(high.x()) + 3 - column, Floor(high.y()) + 3 - row}, extent.low,
                extent.high);
  return extent;
}

}  // namespace lascaux::internal

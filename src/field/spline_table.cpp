#include "spline_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bicubic.h"

namespace lascaux::internal {
namespace {

constexpr int kBefore = kTableReach + 1, kBehind = kTableReach + 3;

constexpr int kTileSide = 16;

/// Of a cell's coefficients, which are the fewest that anybody asks for. A power of 2.
constexpr int kWindowSide = 4;

float Larger(float a, float b) { return a > b ? a : b; }
float Smaller(float a, float b) { return a < b ? a : b; }

/// values[i] becomes that of both, `step` apart, wherever there are two.
template <typename Choose>
void Join(std::vector<float>& values, std::size_t step, const Choose& choose) {
  float* const at = values.data();
  for (std::size_t i = 0; i + step < values.size(); ++i) at[i] = choose(at[i], at[i + step]);
}

SplineTable::Extent Nothing() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
}

void Extend(SplineTable::Extent& extent, int channel, float low, float high) {
  extent.low[channel] = std::min(extent.low[channel], low);
  extent.high[channel] = std::max(extent.high[channel], high);
}

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
  FindTileExtents();
}

void SplineTable::FindTileExtents() {
  const int across = stride_ / shape_.channels, down = kBefore + shape_.rows + kBehind;
  tiles_across_ = (across - 1) / kTileSide + 1;
  const auto stride = static_cast<std::size_t>(stride_);
  const float* from = coefficients_.data();
  for (int row = 0; row < down; row += kTileSide) {
    // Of the rows together first, which is done for many columns at once.
    std::vector<float> low(from, from + stride), high = low;
    for (int end = std::min(row + kTileSide, down), j = row; j < end; ++j, from += stride) {
      for (std::size_t i = 0; i < stride; ++i) {
        low[i] = from[i] < low[i] ? from[i] : low[i];
        high[i] = from[i] > high[i] ? from[i] : high[i];
      }
    }
    for (int column = 0; column < across; ++column) {
      if (column % kTileSide == 0) tiles_.push_back(Nothing());
      for (int k = 0; k < shape_.channels; ++k) {
        const auto i = static_cast<std::size_t>(column * shape_.channels + k);
        Extend(tiles_.back(), k, low[i], high[i]);
      }
    }
  }
}

/// Windows that go on in the next row are among them; nobody asks for these.
void SplineTable::FindWindows() {
  const std::size_t ways[2] = {static_cast<std::size_t>(shape_.channels),
                               static_cast<std::size_t>(stride_)};
  const auto differences = [this](std::size_t step) {
    std::vector<float> result(coefficients_.size());
    for (std::size_t i = 0; i + step < result.size(); ++i)
      result[i] = std::abs(coefficients_[i + step] - coefficients_[i]);
    return result;
  };
  least_ = greatest_ = coefficients_;
  by_x_ = differences(ways[0]);
  by_y_ = differences(ways[1]);
  for (const std::size_t way : ways) {
    for (std::size_t step = way; step < kWindowSide * way; step *= 2) {
      Join(least_, step, Smaller);
      Join(greatest_, step, Larger);
      Join(by_x_, step, Larger);
      Join(by_y_, step, Larger);
    }
  }
}

SplineTable::SplineTable(const DepthMap& map) : origin_(map.origin), cell_(map.cell) {
  Fill({2, map.columns, map.rows}, [&map](int column, int row) {
    const std::size_t i = IndexOf(map, column, row);
    return std::array{map.middle[i], map.steepness[i]};
  });
  FindWindows();
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

KernelRectangle SplineTable::CellsOf(const Eigen::AlignedBox2d& box) const {
  // Places in cells are no less than -kTableReach: what is cut off is what floor() would cut off.
  const auto floor = [](const Eigen::Vector2d& cells) -> Eigen::Array2i {
    return (cells.array() + kTableReach).cast<int>() - kTableReach;
  };
  const Eigen::Array2i first = floor(InCells(box.min())) - 1;
  const Eigen::Array2i size = floor(InCells(box.max())) + 3 - first;
  return {first.x(), first.y(), size.x(), size.y()};
}

SplineTable::Extent SplineTable::ExtentOn(const Eigen::AlignedBox2d& box,
                                          const BlockKernel& kernel) const {
  Extent extent;
  kernel.extent(From(origin_), CellsOf(box), extent.low, extent.high);
  return extent;
}

SplineTable::Extent SplineTable::RoughExtentOn(const Eigen::AlignedBox2d& box) const {
  const KernelRectangle cells = CellsOf(box);
  const int first = (cells.column + kBefore) / kTileSide,
            last = (cells.column + cells.columns - 1 + kBefore) / kTileSide,
            bottom = (cells.row + cells.rows - 1 + kBefore) / kTileSide;
  Extent extent = Nothing();
  for (int row = (cells.row + kBefore) / kTileSide; row <= bottom; ++row) {
    for (int column = first; column <= last; ++column) {
      const Extent& tile = tiles_[static_cast<std::size_t>(row * tiles_across_ + column)];
      for (int k = 0; k < shape_.channels; ++k) Extend(extent, k, tile.low[k], tile.high[k]);
    }
  }
  return extent;
}

SplineTable::MapBounds SplineTable::BoundsOn(const Eigen::AlignedBox2d& box) const {
  const KernelRectangle cells = CellsOf(box);
  MapBounds bounds{Nothing(), {}};
  float by_x[2] = {}, by_y[2] = {};
  // Windows side by side, the last ones moved back so that they end with the rectangle.
  for (int row = 0; row < cells.rows; row += kWindowSide) {
    const int first = (cells.row + std::min(row, cells.rows - kWindowSide) + kBefore) * stride_;
    for (int column = 0; column < cells.columns; column += kWindowSide) {
      const int begin = cells.column + std::min(column, cells.columns - kWindowSide) + kBefore;
      for (int k = 0; k < 2; ++k) {
        const auto i = static_cast<std::size_t>(first + begin * shape_.channels + k);
        Extend(bounds.extent, k, least_[i], greatest_[i]);
        by_x[k] = std::max(by_x[k], by_x_[i]);
        by_y[k] = std::max(by_y[k], by_y_[i]);
      }
    }
  }
  for (int k = 0; k < 2; ++k)
    bounds.slope[k] = std::sqrt(by_x[k] * by_x[k] + by_y[k] * by_y[k]) / static_cast<float>(cell_);
  return bounds;
}

}  // namespace lascaux::internal

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

/// @file
/// Uniform bicubic B-splines: what the tables over the plane have in common.
///
/// Source: C. de Boor, "A Practical Guide to Splines", 1978.

namespace lascaux::internal {

/// The four cubic B-splines that are not 0 at a share `t` of a cell, and their derivatives.
struct SplineWeights {
  std::array<double, 4> value, slope;

  explicit SplineWeights(double t) {
    const double u = 1 - t;
    value = {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
             (3 * u * u * u - 6 * u * u + 4) / 6, t * t * t / 6};
    slope = {-u * u / 2, (3 * t * t - 4 * t) / 2, -(3 * u * u - 4 * u) / 2, t * t / 2};
  }
};

/// Without the call that floor() is on machines of the baseline.
inline int Floor(double x) {
  const int whole = static_cast<int>(x);
  return x < whole ? whole - 1 : whole;
}

/// Values of `N` splines over the same cells, and their derivatives, by cells.
template <int N>
struct SplineSamples {
  using Row = Eigen::Array<double, N, 1>;
  Row value = Row::Zero(), by_x = Row::Zero(), by_y = Row::Zero();
};

/// The splines whose coefficients are at(column, row), at a place that is given in cells.
template <int N, typename At>
SplineSamples<N> EvaluateSplines(const Eigen::Vector2d& cells, At at) {
  using Row = typename SplineSamples<N>::Row;
  const int column = Floor(cells.x()), row = Floor(cells.y());
  const SplineWeights x(cells.x() - column), y(cells.y() - row);
  SplineSamples<N> result;
  for (int j = 0; j < 4; ++j) {
    Row value = Row::Zero(), slope = Row::Zero();
    for (int i = 0; i < 4; ++i) {
      const Row c = at(column - 1 + i, row - 1 + j);
      value += x.value[static_cast<std::size_t>(i)] * c;
      slope += x.slope[static_cast<std::size_t>(i)] * c;
    }
    const auto k = static_cast<std::size_t>(j);
    result.value += y.value[k] * value;
    result.by_x += y.value[k] * slope;
    result.by_y += y.slope[k] * value;
  }
  return result;
}

}  // namespace lascaux::internal

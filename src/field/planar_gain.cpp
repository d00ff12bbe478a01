#include "lascaux/field/planar_gain.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lascaux {
namespace {

/// The four cubic B-splines that are not 0 at a share `t` of a cell, and their derivatives.
struct Weights {
  std::array<double, 4> value, slope;

  explicit Weights(double t) {
    const double u = 1 - t;
    value = {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
             (3 * u * u * u - 6 * u * u + 4) / 6, t * t * t / 6};
    slope = {-u * u / 2, (3 * t * t - 4 * t) / 2, -(3 * u * u - 4 * u) / 2, t * t / 2};
  }
};

int Floor(double x) { return static_cast<int>(std::floor(x)); }

}  // namespace

LogGain EvaluateLogGain(const PlanarGain& gain, const Eigen::Vector2d& place) {
  const Eigen::Vector2d at = (place - gain.origin) / gain.cell;
  // Beyond two cells around the table all is 0, and a cast of what is far beyond would overflow.
  if (!(at.minCoeff() > -2) || !(at.x() < gain.columns + 1) || !(at.y() < gain.rows + 1)) return {};
  const int column = Floor(at.x()), row = Floor(at.y());
  const Weights x(at.x() - column), y(at.y() - row);
  LogGain result;
  for (int j = 0; j < 4; ++j) {
    double value = 0, slope = 0;
    for (int i = 0; i < 4; ++i) {
      const double c = static_cast<double>(gain.At(column - 1 + i, row - 1 + j));
      value += x.value[static_cast<std::size_t>(i)] * c;
      slope += x.slope[static_cast<std::size_t>(i)] * c;
    }
    const auto k = static_cast<std::size_t>(j);
    result.value += y.value[k] * value;
    result.gradient.x() += y.value[k] * slope;
    result.gradient.y() += y.slope[k] * value;
  }
  result.gradient /= gain.cell;
  return result;
}

LogGainRange RangeOf(const PlanarGain& gain, const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d limit(gain.columns + 1, gain.rows + 1), least(-2, -2);
  const Eigen::Vector2d low =
      ((box.min() - gain.origin) / gain.cell).cwiseMax(least).cwiseMin(limit);
  const Eigen::Vector2d high =
      ((box.max() - gain.origin) / gain.cell).cwiseMax(least).cwiseMin(limit);
  // The table's surroundings are 0, and any box may reach them.
  LogGainRange range;
  for (int row = std::max(0, Floor(low.y()) - 1);
       row <= std::min(gain.rows - 1, Floor(high.y()) + 2); ++row) {
    for (int column = std::max(0, Floor(low.x()) - 1);
         column <= std::min(gain.columns - 1, Floor(high.x()) + 2); ++column) {
      const double c = static_cast<double>(gain.At(column, row));
      range.lower = std::min(range.lower, c);
      range.upper = std::max(range.upper, c);
    }
  }
  return range;
}

}  // namespace lascaux

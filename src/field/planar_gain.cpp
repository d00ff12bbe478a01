#include "lascaux/field/planar_gain.h"

#include <algorithm>

#include "bicubic.h"

namespace lascaux {

using internal::Floor;

LogGain EvaluateLogGain(const PlanarGain& gain, const Eigen::Vector2d& place) {
  const Eigen::Vector2d at = (place - gain.origin) / gain.cell;
  // Beyond two cells around the table all is 0, and a cast of what is far beyond would overflow.
  if (!(at.minCoeff() > -2) || !(at.x() < gain.columns + 1) || !(at.y() < gain.rows + 1)) return {};
  const auto sample = internal::EvaluateSplines<1>(at, [&gain](int column, int row) {
    return Eigen::Array<double, 1, 1>(static_cast<double>(gain.At(column, row)));
  });
  return {sample.value[0], {sample.by_x[0] / gain.cell, sample.by_y[0] / gain.cell}};
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

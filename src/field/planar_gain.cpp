#include "lascaux/field/planar_gain.h"

#include "bicubic.h"

namespace lascaux {

LogGain EvaluateLogGain(const PlanarGain& gain, const Eigen::Vector2d& place) {
  const Eigen::Vector2d at = (place - gain.origin) / gain.cell;
  // Beyond two cells around the table all is 0, and a cast of what is far beyond would overflow.
  if (!(at.minCoeff() > -2) || !(at.x() < gain.columns + 1) || !(at.y() < gain.rows + 1)) return {};
  const auto sample = internal::EvaluateSplines<1>(at, [&gain](int column, int row) {
    return Eigen::Array<double, 1, 1>(static_cast<double>(gain.At(column, row)));
  });
  return {sample.value[0], {sample.by_x[0] / gain.cell, sample.by_y[0] / gain.cell}};
}

}  // namespace lascaux

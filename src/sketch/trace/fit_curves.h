#pragma once

#include <vector>

#include "lascaux/sketch/bezier.h"

namespace lascaux::trace {

/// Cubic curves through a line of points, its first and last exactly, the others to within
/// `tolerance`; pieces join with one tangent. `smooth_ring`: the last point is the first and the
/// curve is to have one tangent there, too. Least squares after Schneider (1990), as lib2geom has
/// it.
enum class Ends : std::uint8_t { kFree, kSmoothRing };
std::vector<CubicBezier> FitCurves(const std::vector<Eigen::Vector2d>& points, double tolerance,
                                   Ends ends);

}  // namespace lascaux::trace

#pragma once

#include <algorithm>

#include "compiled_data.h"

/// @file
/// What bounds on one ball and on several have in common.

namespace lascaux::internal {

struct Range {
  double lower, upper;
};

inline Range Ricci(const Range& a, const Range& b, const RicciExponent& n) {
  const auto blend = [&n](double x, double y) {
    const double high = std::max(x, y);
    return high > 0 ? high * n.Root(1 + n.Power(std::min(x, y) / high)) : 0;
  };
  return {blend(a.lower, b.lower), blend(a.upper, b.upper)};
}

/// What is known of a tip's last piece, whose field has no bound at the tip: more than any other
/// field has.
inline constexpr float kAnything = 1e4f;

/// Bounds of a point's field in a ball `distance` from it.
Range RangeOfPoint(const CompiledPrimitive& point, double distance, double radius);

/// A ball around all that a depth map makes of one.
Ball FlattenBall(const CompiledPart& part, const Ball& ball);

/// Bounds of a field times its gain, if it has one.
FieldBounds Amplified(const FieldBounds& bounds, const Ball& ball, const CompiledField::Data& data);

}  // namespace lascaux::internal

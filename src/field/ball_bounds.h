#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// Each part that reaches the balls (a `part`, what it has by itself as `own`) blended with its
/// parent, which comes before it: sets `parent`, its place in the list, and `branch`.
template <typename Reached, typename Blend>
void BlendWithParents(std::vector<Reached>& reached, const CompiledField::Data& data,
                      const Blend& blend) {
  for (std::size_t i = 0; i < reached.size(); ++i) {
    Reached& here = reached[i];
    here.branch = here.own;
    const int parent = data.parts[here.part].parent;
    for (std::size_t k = 0; parent >= 0 && k < i; ++k) {
      if (reached[k].part != static_cast<std::uint32_t>(parent)) continue;
      here.parent = static_cast<int>(k);
      here.branch = blend(here.own, reached[k].own, data.part_exponent);
    }
  }
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

#pragma once

#include <array>

#include "volume/four.h"

/// @file
/// Quadrilaterals around edges of a lattice, four at a time.

namespace lascaux {

/// Corners as they are seen along the edges: beside the edge and above its lower end, in units of
/// the lattice.
struct SeenCorners {
  Four x, y, height;
};

LASCAUX_INLINE Four Cross(const SeenCorners& p, const SeenCorners& q) {
  return p.x * q.y - p.y * q.x;
}

LASCAUX_INLINE Four Area(const SeenCorners& p, const SeenCorners& q, const SeenCorners& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// IsInEnvelope() of envelope.h in single precision.
LASCAUX_INLINE FourInts AreInEnvelope(const std::array<SeenCorners, 4>& d0_d1_a_b, float margin) {
  const auto& [d0, d1, a, b] = d0_d1_a_b;
  const Four edge = Cross(d0, d1);
  const FourInts takes_b = edge * Area(d0, d1, a) > 0;
  const SeenCorners beyond = {takes_b ? b.x : a.x, takes_b ? b.y : a.y,
                              takes_b ? b.height : a.height};
  const Four area = Area(d0, d1, beyond);
  const Four crossing =
      Cross(d1, beyond) * d0.height + Cross(beyond, d0) * d1.height + edge * beyond.height;
  const Four above = area > 0 ? crossing : -crossing;
  return (Size(edge) > margin) & (Size(area) > margin) & (area * edge <= 0) & (above > margin) &
         (above < Size(area) - margin);
}

LASCAUX_INLINE Four SquaredLength(const SeenCorners& a, const SeenCorners& b) {
  const Four x = a.x - b.x, y = a.y - b.y, height = a.height - b.height;
  return x * x + y * y + height * height;
}

/// Is the diagonal from the first corner the better one? That is the shorter one that keeps the
/// quadrilateral within the envelope of its edge by `margin`, or the shorter one where none does.
/// The corners go round.
LASCAUX_INLINE FourInts AreCutFromFirst(const std::array<SeenCorners, 4>& q, float margin) {
  const FourInts first_is_shorter = SquaredLength(q[0], q[2]) <= SquaredLength(q[1], q[3]);
  const FourInts first_is_good = AreInEnvelope({q[0], q[2], q[1], q[3]}, margin);
  const FourInts second_is_good = AreInEnvelope({q[1], q[3], q[2], q[0]}, margin);
  return (first_is_shorter & (first_is_good | ~second_is_good)) |
         (~first_is_shorter & first_is_good & ~second_is_good);
}

}  // namespace lascaux

#pragma once

#include <array>
#include <cmath>

namespace lascaux {

/// A corner of a quadrilateral around an edge of a lattice, seen along it: beside the edge and
/// above its lower end, in units of the lattice.
struct SeenCorner {
  double x, y, height;
};

inline double Cross(const SeenCorner& p, const SeenCorner& q) { return p.x * q.y - p.y * q.x; }

/// Twice the area of the triangle p q r.
inline double Area(const SeenCorner& p, const SeenCorner& q, const SeenCorner& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// Is the quadrilateral d0 b d1 a, one corner in each cell around an edge and cut from d0 to d1,
/// within the envelope of the edge (lattice_proof.h), by `margin` of the lattice at least?
inline bool IsInEnvelope(const std::array<SeenCorner, 4>& d0_d1_a_b, double margin) {
  const auto& [d0, d1, a, b] = d0_d1_a_b;
  const double edge = Cross(d0, d1);  // on which side of the diagonal the edge is
  if (!(std::abs(edge) > margin)) return false;
  const SeenCorner& beyond = edge * Area(d0, d1, a) > 0 ? b : a;
  const double area = Area(d0, d1, beyond);
  if (!(std::abs(area) > margin) || area * edge > 0) return false;
  // Where the plane of the triangle without the edge crosses it, times the area.
  const double sign = area > 0 ? 1 : -1;
  const double crossing =
      sign * (Cross(d1, beyond) * d0.height + Cross(beyond, d0) * d1.height + edge * beyond.height);
  return crossing > margin && crossing < std::abs(area) - margin;
}

}  // namespace lascaux

#include "volume/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace lascaux {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 ToPoint(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

Kernel::Triangle_3 ToTriangle(const Corners& t) {
  return {ToPoint(t[0]), ToPoint(t[1]), ToPoint(t[2])};
}

}  // namespace

bool AreCollinear(const Corners& t) {
  return CGAL::collinear(ToPoint(t[0]), ToPoint(t[1]), ToPoint(t[2]));
}

bool TrianglesMeet(const Corners& a, const Corners& b) {
  return CGAL::do_intersect(ToTriangle(a), ToTriangle(b));
}

bool SegmentMeetsTriangle(const Eigen::Vector3f& p, const Eigen::Vector3f& q, const Corners& t) {
  if (p == q) return ToTriangle(t).has_on(ToPoint(p));
  return CGAL::do_intersect(Kernel::Segment_3(ToPoint(p), ToPoint(q)), ToTriangle(t));
}

bool OverlapAcrossEdge(const Eigen::Vector3f& p, const Eigen::Vector3f& q, const Eigen::Vector3f& a,
                       const Eigen::Vector3f& b) {
  if (!CGAL::coplanar(ToPoint(p), ToPoint(q), ToPoint(a), ToPoint(b))) return false;
  return CGAL::coplanar_orientation(ToPoint(p), ToPoint(q), ToPoint(a), ToPoint(b)) ==
         CGAL::POSITIVE;
}

}  // namespace lascaux

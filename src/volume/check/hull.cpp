#include "volume/check/hull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lascaux {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2d NearestOnEdge(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return a + t * along;
}

}  // namespace

std::vector<Vector2d> ConvexHull(std::vector<Vector2d> points) {
  const auto before = [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vector2d> hull;
  const auto add = [&hull](const Vector2d& p, std::size_t least) {
    while (hull.size() > least && Cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vector2d& p : points) add(p, 1);
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

Vector2d NearestOnBorder(const Vector2d& p, const std::vector<Vector2d>& hull) {
  Vector2d nearest = hull.front();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d q = NearestOnEdge(p, hull[i], hull[(i + 1) % hull.size()]);
    if ((p - q).squaredNorm() < (p - nearest).squaredNorm()) nearest = q;
  }
  return nearest;
}

double SignedDistanceInside(const Vector2d& p, const std::vector<Vector2d>& hull) {
  if (hull.empty()) return -std::numeric_limits<double>::infinity();
  const double nearest = (p - NearestOnBorder(p, hull)).norm();
  bool inside = hull.size() >= 3;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
    inside = inside && Cross(b - a, p - a) > 0;
  }
  return inside ? nearest : -nearest;
}

}  // namespace lascaux

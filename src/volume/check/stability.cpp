#include "lascaux/volume/stability.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Andrew's monotone chain, 1979: counter-clockwise, no three corners on a line.
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

double DistanceToEdge(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return (p - a - t * along).norm();
}

double SignedDistanceInside(const Vector2d& p, const std::vector<Vector2d>& hull) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = hull.size() >= 3;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
    nearest = std::min(nearest, DistanceToEdge(p, a, b));
    inside = inside && Cross(b - a, p - a) > 0;
  }
  return inside ? nearest : -nearest;
}

bool IsValid(const Mesh& mesh) {
  for (const Eigen::Vector3f& v : mesh.vertices)
    if (!v.allFinite()) return false;
  for (const auto& t : mesh.triangles)
    if (*std::max_element(t.begin(), t.end()) >= mesh.vertices.size()) return false;
  return !mesh.triangles.empty();
}

}  // namespace

std::optional<Stability> MeasureStability(const Mesh& mesh, double contact) {
  if (!IsValid(mesh)) return std::nullopt;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& v : mesh.vertices) box.extend(v.cast<double>());
  const Vector3d origin = box.center();
  double volume = 0;
  Vector3d moment = Vector3d::Zero();
  for (const auto& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]].cast<double>() - origin;
    const Vector3d b = mesh.vertices[t[1]].cast<double>() - origin;
    const Vector3d c = mesh.vertices[t[2]].cast<double>() - origin;
    const double six = a.dot(b.cross(c));
    volume += six;
    moment += six * (a + b + c) / 4;
  }
  if (!(std::abs(volume) > 0)) return std::nullopt;
  Stability stability;
  stability.center_of_mass = origin + moment / volume;
  std::vector<Vector2d> feet;
  for (const Eigen::Vector3f& v : mesh.vertices)
    if (static_cast<double>(v.y()) <= box.min().y() + contact)
      feet.emplace_back(static_cast<double>(v.x()), static_cast<double>(v.z()));
  const Vector2d below(stability.center_of_mass.x(), stability.center_of_mass.z());
  stability.margin = SignedDistanceInside(below, ConvexHull(std::move(feet)));
  return stability;
}

}  // namespace lascaux

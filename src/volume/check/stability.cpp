#include "lascaux/volume/stability.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "volume/check/hull.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

#include "lascaux/volume/stability.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "volume/check/hull.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStep = 0.5 * M_PI / 180;  // of rolling
/// A solid reaches the farthest tilt in a quarter of these steps; what is none may go round.
constexpr int kMostSteps = 360;

/// What touches the ground, seen along `down` from the centre of mass.
struct Support {
  Vector3d down;
  Vector3d u, v;               ///< axes of the ground
  std::vector<Vector2d> hull;  ///< in u and v
};

Support SupportOf(const Mesh& mesh, const Vector3d& center, const Vector3d& down, double contact) {
  Support support;
  support.down = down;
  support.u = down.unitOrthogonal();
  support.v = down.cross(support.u);
  // Once: of places that are far away two results of one formula can be further apart than feet
  // are from the ground.
  std::vector<double> depths;
  depths.reserve(mesh.vertices.size());
  for (const Eigen::Vector3f& p : mesh.vertices)
    depths.push_back(down.dot(p.cast<double>() - center));
  const double lowest = *std::max_element(depths.begin(), depths.end());
  std::vector<Vector2d> feet;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] < lowest - contact) continue;
    const Vector3d arm = mesh.vertices[i].cast<double>() - center;
    feet.emplace_back(support.u.dot(arm), support.v.dot(arm));
  }
  support.hull = ConvexHull(std::move(feet));
  return support;
}

/// The solid rolls to where its centre of mass sinks fastest: over the place of the support that is
/// nearest to below it. Returns the degrees when that is above the support, or when it would roll
/// back: it rests between, on a face that is larger than steps are fine.
double RollToRest(const Mesh& mesh, const Vector3d& center, Support support, double contact) {
  const Vector3d start = support.down;
  Vector3d last = Vector3d::Zero();
  double angle = 0;
  for (int step = 0; step < kMostSteps && angle < kFarthestTilt; ++step) {
    if (SignedDistanceInside(Vector2d::Zero(), support.hull) > 0) break;
    const Vector2d pivot = NearestOnBorder(Vector2d::Zero(), support.hull);
    const Vector3d towards = pivot.x() * support.u + pivot.y() * support.v;
    if (!(towards.norm() > 0) || towards.dot(last) < 0) break;
    last = towards;
    const Vector3d down =
        (std::cos(kStep) * support.down - std::sin(kStep) * towards.normalized()).normalized();
    support = SupportOf(mesh, center, down, contact);
    angle = std::acos(std::clamp(start.dot(down), -1.0, 1.0)) * 180 / M_PI;
  }
  return std::min(angle, kFarthestTilt);
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
  // Where faces of no solid nearly cancel, it is anywhere, or nowhere.
  if (!box.contains(stability.center_of_mass)) return std::nullopt;
  const Support standing = SupportOf(mesh, stability.center_of_mass, -Vector3d::UnitY(), contact);
  stability.margin = SignedDistanceInside(Vector2d::Zero(), standing.hull);
  stability.tilt = RollToRest(mesh, stability.center_of_mass, standing, contact);
  return stability;
}

}  // namespace lascaux

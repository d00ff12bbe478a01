#include "sketch/depth/pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// The paper's limit for the angle between a limb and its partner.
constexpr double kMaxAngle = std::numbers::pi / 4;
/// The partner's bulk may swing more than its joint: legs in mid-step.
constexpr double kMaxSwing = std::numbers::pi / 3;

/// Axis of a limb at its root: p0 at its top inside the parent, p1 between the closed ends.
struct Axis {
  Vector2d top, root;
};

Axis AxisOf(const Part& limb) {
  const LimbRoot& root = *limb.root;
  const Vector2d middle = 0.5 * (root.closed[0] + root.closed[1]);
  const Vector2d top = PointAtLength(root.open_completion, 0.5 * Length(root.open_completion));
  const double width = (root.closed[1] - root.closed[0]).norm();
  // Short suggestive curves leave hardly any axis: take the limb's own direction, one width long.
  if ((middle - top).norm() >= 0.5 * width) return {top, middle};
  const Vector2d away = (Centroid(limb.outline.points) - middle).stableNormalized();
  return {middle - width * away, middle};
}

/// Angle of a candidate with the limb, if it is within the limits; smaller for those that touch the limb itself.
std::optional<double> AngleOf(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency, int limb, int candidate) {
  const Part& part = parts.parts[static_cast<std::size_t>(limb)];
  const Axis axis = AxisOf(part);
  const Vector2d bulk = Centroid(parts.parts[static_cast<std::size_t>(candidate)].outline.points);
  if (AngleBetween(Centroid(part.outline.points) - axis.top, bulk - axis.top) > kMaxSwing) return std::nullopt;
  const auto joint = MiddleOfShared(map, parts, adjacency, {candidate, *part.over});
  const double angle = AngleBetween(axis.root - axis.top, joint.value_or(bulk) - axis.top);
  const bool touches = adjacency.shared[static_cast<std::size_t>(limb)].contains(candidate);
  if (angle > (touches ? kMaxSwing : kMaxAngle)) return std::nullopt;
  return touches ? 0.5 * angle : angle;
}

bool MayBeFarSide(const Parts& parts, const Adjacency&, int candidate, int body) {
  const Part& part = parts.parts[static_cast<std::size_t>(candidate)];
  if (part.kind != PartKind::kBorder || candidate == body) return false;
  return std::none_of(parts.parts.begin(), parts.parts.end(),
                      [&](const Part& other) { return other.over == candidate; });
}

/// Border parts that touch only a limb, its far side, or the outside.
void AddPieces(const Parts& parts, const Adjacency& adjacency, int body, std::vector<std::optional<int>>& far_of) {
  for (bool again = true; again;) {
    again = false;
    for (int i = 0; i < static_cast<int>(parts.parts.size()); ++i) {
      if (far_of[static_cast<std::size_t>(i)] || !MayBeFarSide(parts, adjacency, i, body)) continue;
      std::optional<int> limb;
      bool only = true;
      for (const auto& [other, length] : adjacency.shared[static_cast<std::size_t>(i)]) {
        const auto owner = far_of[static_cast<std::size_t>(other)];
        if (!owner) {
          only = only && parts.parts[static_cast<std::size_t>(other)].kind == PartKind::kLimb;
          continue;
        }
        only = only && (!limb || limb == owner);
        limb = owner;
      }
      if (!limb || !only) continue;
      far_of[static_cast<std::size_t>(i)] = limb;
      again = true;
    }
  }
}

}  // namespace

std::vector<std::optional<int>> FindFarSides(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency, int body) {
  const int n = static_cast<int>(parts.parts.size());
  std::vector<std::optional<int>> far_of(parts.parts.size());
  std::vector<double> angle_of(parts.parts.size(), std::numbers::pi);
  for (int limb = 0; limb < n; ++limb) {
    if (parts.parts[static_cast<std::size_t>(limb)].kind != PartKind::kLimb) continue;
    std::vector<int> candidates = March(map, parts, adjacency, limb);
    for (const auto& [other, length] : adjacency.shared[static_cast<std::size_t>(limb)]) candidates.push_back(other);
    for (const int candidate : candidates) {
      if (!MayBeFarSide(parts, adjacency, candidate, body)) continue;
      const auto angle = AngleOf(map, parts, adjacency, limb, candidate);
      if (!angle || *angle >= angle_of[static_cast<std::size_t>(candidate)]) continue;
      angle_of[static_cast<std::size_t>(candidate)] = *angle;
      far_of[static_cast<std::size_t>(candidate)] = limb;
    }
  }
  AddPieces(parts, adjacency, body, far_of);
  return far_of;
}

}  // namespace lascaux

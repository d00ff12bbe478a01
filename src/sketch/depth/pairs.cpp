#include "sketch/depth/pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// The tips of a pair in mid-step, seen from the limb's top, stay within this angle ...
constexpr double kMaxSwing = 95 * std::numbers::pi / 180;
/// ... and all differences together below this (radians; one e-fold of distance counts for two).
constexpr double kMaxUnlikeness = 2.7;
/// A further piece of a far side has to be more alike than the far side itself: it is only hidden
/// in between.
constexpr double kMaxPieceUnlikeness = 1.2;

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

Vector2d FarthestFrom(const Vector2d& origin, const Outline& outline) {
  return *std::max_element(outline.points.begin(), outline.points.end(),
                           [&](const Vector2d& a, const Vector2d& b) {
                             return (a - origin).squaredNorm() < (b - origin).squaredNorm();
                           });
}

/// How unlike a candidate is to the limb's far side: the angle at the joint (the paper's), the
/// angle between the tips and the logarithm of their distances' ratio, all seen from the limb's
/// top; none if it is out of the question.
std::optional<double> Unlikeness(const PlanarMap& map, const Parts& parts,
                                 const Adjacency& adjacency, const std::pair<int, int>& pair) {
  const auto [limb, candidate] = pair;
  const Part& part = parts.parts[static_cast<std::size_t>(limb)];
  const Part& other = parts.parts[static_cast<std::size_t>(candidate)];
  const Axis axis = AxisOf(part);
  const Vector2d near_tip = FarthestFrom(axis.top, part.outline) - axis.top;
  const Vector2d far_tip = FarthestFrom(axis.top, other.outline) - axis.top;
  const double swing = AngleBetween(near_tip, far_tip);
  const double reach = std::abs(std::log(far_tip.norm() / near_tip.norm()));
  const auto joint = MiddleOfShared(map, parts, adjacency, {candidate, *part.over});
  const double angle = joint ? AngleBetween(axis.root - axis.top, *joint - axis.top) : 0.0;
  const bool touches = adjacency.shared[static_cast<std::size_t>(limb)].contains(candidate);
  const double unlikeness = angle * (touches ? 0.25 : 0.5) + swing + 2 * reach;
  if (swing > kMaxSwing || unlikeness > kMaxUnlikeness) return std::nullopt;
  return unlikeness;
}

bool MayBeFarSide(const Parts& parts, int candidate, int body) {
  const Part& part = parts.parts[static_cast<std::size_t>(candidate)];
  if (part.kind != PartKind::kBorder || candidate == body || part.far_side_of) return false;
  return std::none_of(parts.parts.begin(), parts.parts.end(),
                      [&](const Part& other) { return other.over == candidate; });
}

/// Border parts that touch only a limb, its far side, or the outside.
void AddPieces(const Parts& parts, const Adjacency& adjacency, int body,
               std::vector<std::optional<int>>& far_of) {
  for (bool again = true; again;) {
    again = false;
    for (int i = 0; i < static_cast<int>(parts.parts.size()); ++i) {
      if (far_of[static_cast<std::size_t>(i)] || !MayBeFarSide(parts, i, body)) continue;
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

/// A limb and a cell that may be its far side.
struct Match {
  double cost = 0;
  int limb = 0, cell = 0;
};

std::vector<Match> Matches(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
                           int body) {
  std::vector<Match> matches;
  for (int limb = 0; limb < static_cast<int>(parts.parts.size()); ++limb) {
    if (parts.parts[static_cast<std::size_t>(limb)].kind != PartKind::kLimb) continue;
    std::set<int> candidates;
    for (const int met : March(map, parts, adjacency, limb)) candidates.insert(met);
    for (const auto& [other, length] : adjacency.shared[static_cast<std::size_t>(limb)])
      candidates.insert(other);
    for (const int cell : candidates) {
      if (!MayBeFarSide(parts, cell, body)) continue;
      if (const auto cost = Unlikeness(map, parts, adjacency, {limb, cell}))
        matches.push_back({*cost, limb, cell});
    }
  }
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& a, const Match& b) { return a.cost < b.cost; });
  return matches;
}

/// Tries to give `limb` a cell, moving other limbs to other cells if need be (an augmenting path).
bool Augment(const std::vector<Match>& matches, int limb, std::set<int>& visited,
             std::map<int, int>& limb_of) {
  for (const Match& match : matches) {
    if (match.limb != limb || !visited.insert(match.cell).second) continue;
    const auto taken = limb_of.find(match.cell);
    if (taken != limb_of.end() && !Augment(matches, taken->second, visited, limb_of)) continue;
    limb_of[match.cell] = limb;
    return true;
  }
  return false;
}

}  // namespace

std::vector<std::optional<FarSide>> FindFarSides(const PlanarMap& map, const Parts& parts,
                                                 const Adjacency& adjacency, int body) {
  const std::vector<Match> matches = Matches(map, parts, adjacency, body);
  // As many limbs as possible get a far side, the most alike first; then what is left joins as
  // further pieces.
  std::map<int, int> limb_of;
  std::set<int> tried;
  for (const Match& match : matches) {
    if (!tried.insert(match.limb).second) continue;
    std::set<int> visited;
    Augment(matches, match.limb, visited, limb_of);
  }
  std::vector<std::optional<int>> far_of(parts.parts.size());
  for (const auto& [cell, limb] : limb_of) far_of[static_cast<std::size_t>(cell)] = limb;
  for (std::size_t i = 0; i < far_of.size(); ++i) {
    if (parts.parts[i].far_side_of) far_of[i] = parts.parts[i].far_side_of;
  }
  for (const Match& match : matches) {
    auto& far = far_of[static_cast<std::size_t>(match.cell)];
    const bool touches =
        adjacency.shared[static_cast<std::size_t>(match.limb)].contains(match.cell);
    if (!far && touches && match.cost < kMaxPieceUnlikeness) far = match.limb;
  }
  AddPieces(parts, adjacency, body, far_of);
  std::vector<std::optional<FarSide>> far_sides(far_of.size());
  for (std::size_t i = 0; i < far_of.size(); ++i) {
    if (far_of[i]) far_sides[i] = FarSide{*far_of[i], parts.parts[i].score, 0};
  }
  for (const Match& match : matches) {
    auto& far = far_sides[static_cast<std::size_t>(match.cell)];
    if (!far) continue;
    double& score = match.limb == far->limb ? far->score : far->other_score;
    score = std::max(score, 1 - match.cost / kMaxUnlikeness);
  }
  return far_sides;
}

}  // namespace lascaux

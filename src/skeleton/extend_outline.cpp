#include "skeleton/extend_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "lascaux/sketch/bezier.h"
#include "skeleton/index.h"
#include "skeleton/ring.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A joint's side is continued in the direction that it has over this share of the joint's width.
constexpr double kTangentWindow = 0.15;
/// cos 45 degrees: sides that flare more are turned to this.
constexpr double kLeastForward = 0.70710678;
constexpr double kShrink = 0.75;
constexpr double kShallowest = 0.2;
constexpr int kSteps = 24;
/// Joints are found and outlines left by at most this share of the diagonal.
constexpr double kTolerance = 3e-3;

/// A maximal run of shared pieces, `count` of them from `first`.
struct Run {
  int first = 0, count = 0;
};

std::vector<Run> SharedRuns(const Outline& outline) {
  const int n = static_cast<int>(outline.points.size());
  const auto shared = [&](int i) {
    return outline.kinds[Index((i + n) % n)] == OutlineKind::kShared;
  };
  std::vector<Run> runs;
  for (int i = 0; i < n; ++i) {
    if (!shared(i) || shared(i - 1)) continue;
    Run run{i, 1};
    while (run.count < n && shared(i + run.count)) ++run.count;
    runs.push_back(run);
  }
  return runs;
}

/// Point at distance `length` along the ring from vertex `from`, going by `step` (1 or -1).
Vector2d Along(const Ring& ring, int from, int step, double length) {
  const int n = static_cast<int>(ring.size());
  Vector2d here = ring[Index(from)];
  for (int i = 1; i < n; ++i) {
    const Vector2d& next = ring[Index(((from + step * i) % n + n) % n)];
    const double piece = (next - here).norm();
    if (piece >= length) return here + (next - here) * (length / piece);
    length -= piece;
    here = next;
  }
  return here;
}

/// Direction in which a side arrives at the joint, kept within 45 degrees of `inward`.
Vector2d Arrival(const Vector2d& from, const Vector2d& end, const Vector2d& inward) {
  const Vector2d d = end - from;
  const double length = d.norm();
  if (length == 0) return inward;
  const double forward = d.dot(inward) / length;
  if (forward >= kLeastForward) return d / length;
  const Vector2d across(-inward.y(), inward.x());
  const double side = d.dot(across) >= 0 ? 1.0 : -1.0;
  return kLeastForward * (inward + side * across);
}

/// What an extension may cover without being seen: its part, the parent and what lies over the
/// parent.
struct Cover {
  std::vector<const Ring*> rings;
  double tolerance = 0;

  bool Hides(const Vector2d& point) const {
    return std::any_of(rings.begin(), rings.end(), [&](const Ring* ring) {
      return Contains(*ring, point) || NearestOnRing(*ring, point).distance < tolerance;
    });
  }
};

/// How far the run's middle is outside of the parent.
double DistanceTo(const Ring& parent, const Ring& ring, const Run& run) {
  const int n = static_cast<int>(ring.size());
  const int middle = (run.first + run.count / 2) % n;
  const Vector2d at = (ring[Index(middle)] + ring[Index((middle + run.count % 2) % n)]) / 2;
  return std::max(0.0, SignedDistanceToRing(parent, at));
}

/// The runs that are the part's joints with its parent: those on the parent's outline, or else the
/// nearest one, if it is no further away than it is wide, as where a limb over the parent lies
/// between.
std::vector<std::pair<Run, double>> Joints(const Outline& outline, const Ring& parent,
                                           double tolerance) {
  std::vector<std::pair<Run, double>> joints;
  std::pair<Run, double> nearest{{}, std::numeric_limits<double>::infinity()};
  const int n = static_cast<int>(outline.points.size());
  for (const Run& run : SharedRuns(outline)) {
    if (run.count >= n) continue;
    const double distance = DistanceTo(parent, outline.points, run);
    if (distance <= tolerance) joints.emplace_back(run, 0.0);
    if (distance < nearest.second) nearest = {run, distance};
  }
  if (!joints.empty() || !std::isfinite(nearest.second)) return joints;
  const Vector2d chord = outline.points[Index((nearest.first.first + nearest.first.count) % n)] -
                         outline.points[Index(nearest.first.first)];
  if (nearest.second <= chord.norm()) joints.push_back(nearest);
  return joints;
}

/// Inner points of the round end that replaces the run and reaches `gap` further than half of its
/// width.
std::optional<std::vector<Vector2d>> RoundEnd(const Ring& ring, const Run& run, double gap,
                                              const Cover& cover) {
  const int n = static_cast<int>(ring.size());
  const int last = (run.first + run.count) % n;
  const Vector2d a = ring[Index(run.first)], b = ring[Index(last)];
  const double width = (b - a).norm();
  if (width <= cover.tolerance) return std::nullopt;
  // The ring has positive shoelace area, so the outside is to the right of the direction of travel.
  const Vector2d chord = (b - a) / width;
  const Vector2d inward(chord.y(), -chord.x());
  double depth = 0;
  for (int i = 0; i <= run.count; ++i) {
    depth = std::max(depth, (ring[Index((run.first + i) % n)] - a).dot(inward));
  }
  const double window = kTangentWindow * width;
  const Vector2d ta = Arrival(Along(ring, run.first, -1, window), a, inward);
  const Vector2d tb = Arrival(Along(ring, last, 1, window), b, inward);
  for (double share = 1; share >= kShallowest; share *= kShrink) {
    // A cubic with parallel handles h rises by 3/4 h; with h = 2/3 of the chord it is a half circle
    // to 2 %.
    const double handle = 4.0 / 3.0 * (depth + gap + share * width / 2);
    const CubicBezier curve{{a, a + handle * ta, b + handle * tb, b}};
    std::vector<Vector2d> points;
    for (int i = 1; i < kSteps; ++i) points.push_back(curve.At(static_cast<double>(i) / kSteps));
    if (std::all_of(points.begin(), points.end(),
                    [&](const Vector2d& p) { return cover.Hides(p); })) {
      return points;
    }
  }
  return std::nullopt;
}

/// The outline with its joints replaced.
Outline Extended(const Outline& outline, const std::vector<std::pair<Run, double>>& joints,
                 const Cover& cover) {
  const int n = static_cast<int>(outline.points.size());
  std::vector<std::vector<Vector2d>> ends(Index(n));
  std::vector<int> skip(Index(n), 0);
  for (const auto& [run, gap] : joints) {
    std::optional<std::vector<Vector2d>> end = RoundEnd(outline.points, run, gap, cover);
    if (!end) continue;
    ends[Index(run.first)] = std::move(*end);
    skip[Index(run.first)] = run.count;
  }
  const auto first = std::find_if(outline.kinds.begin(), outline.kinds.end(),
                                  [](OutlineKind k) { return k != OutlineKind::kShared; });
  const int start = static_cast<int>(first - outline.kinds.begin());
  Outline extended;
  for (int k = 0; k < n;) {
    const std::size_t i = Index((start + k) % n);
    extended.points.push_back(outline.points[i]);
    extended.kinds.push_back(skip[i] > 0 ? OutlineKind::kCompletion : outline.kinds[i]);
    for (const Vector2d& p : ends[i]) {
      extended.points.push_back(p);
      extended.kinds.push_back(OutlineKind::kCompletion);
    }
    k += std::max(1, skip[i]);
  }
  return extended;
}

}  // namespace

Outline OutlineToFill(const Parts& parts, int part, int parent) {
  const Part& child = parts.parts[Index(part)];
  if (child.over || child.kind == PartKind::kIsland) return child.outline;
  const Ring& support = parts.parts[Index(parent)].outline.points;
  Cover cover{{&child.outline.points, &support}, kTolerance * Diagonal(support)};
  for (const Part& other : parts.parts) {
    if (other.over == parent) cover.rings.push_back(&other.outline.points);
  }
  return Extended(child.outline, Joints(child.outline, support, cover.tolerance), cover);
}

}  // namespace lascaux

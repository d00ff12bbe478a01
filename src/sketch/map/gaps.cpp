#include "sketch/map/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include "sketch/map/outer_walk.h"
#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A face worth closing has at least so many times the area of the gap's own square: whiskers and
/// curls have not.
constexpr double kFaceOverGap = 12;
/// A gap below this share of the diagonal is a slip of the pen; a wider one has to look like one
/// line with a piece missing.
constexpr double kSlip = 0.01;
/// Largest turn between a wider gap and the lines that it joins.
constexpr double kMaxTurn = std::numbers::pi / 3;
/// Lines that run side by side nearer than this may be meant to touch.
constexpr double kSlit = 6e-3;
/// The animal fills at least this share of the drawing's bounds, or its outline is open.
constexpr double kLeastBodyShare = 0.08;
/// Rounds of closing: a closed gap can be the condition of the next.
constexpr int kMaxRounds = 4;

struct Closure {
  Vector2d from, to;
  double score = 0;  ///< small is good
  double area = 0;   ///< of the face that it closes
};

double BoxArea(const PlanarMap& map) {
  Eigen::AlignedBox2d box;
  for (const MapEdge& edge : map.edges) {
    for (const Vector2d& p : edge.points) box.extend(p);
  }
  return box.volume();
}

double LargestFace(const PlanarMap& map) {
  double largest = 0;
  for (const MapCycle& cycle : map.cycles) {
    if (cycle.kind == CycleKind::kBorder) largest = std::max(largest, cycle.area);
  }
  return largest;
}

/// Direction in which the line runs out at a tip.
Vector2d Outward(const PlanarMap& map, const WalkPoint& tip) {
  return -map.Departure(tip.half_edge);
}

/// Cost of joining a tip to a point: its distance, more for a turn; none if it would turn too far.
std::optional<double> Score(const PlanarMap& map, const WalkPoint& tip, const WalkPoint& other,
                            double bridge) {
  const Vector2d way = other.position - tip.position;
  const double distance = way.norm(), slip = kSlip * map.diagonal;
  if (distance > bridge) return std::nullopt;
  double turn = AngleBetween(Outward(map, tip), way);
  if (other.is_tip) turn = std::max(turn, AngleBetween(Outward(map, other), -way));
  if (distance > slip && turn > kMaxTurn) return std::nullopt;
  return distance / bridge * (1 + turn) * (other.is_tip ? 1.0 : 1.5);
}

/// The best closure for one tip of a walk.
std::optional<Closure> BestClosure(const PlanarMap& map, const OuterWalk& walk, std::size_t tip,
                                   double bridge) {
  std::optional<Closure> best;
  for (std::size_t j = 0; j < walk.points.size(); ++j) {
    const double distance = (walk.points[j].position - walk.points[tip].position).norm();
    if (distance == 0 || distance > bridge || walk.Along(tip, j) < 3 * distance) continue;
    const double area = walk.FaceArea(tip, j);
    if (area < kFaceOverGap * distance * distance) continue;
    const auto score = Score(map, walk.points[tip], walk.points[j], bridge);
    if (score && (!best || *score < best->score)) {
      best = {walk.points[tip].position, walk.points[j].position, *score, area};
    }
  }
  return best;
}

/// Closures that join tips of two walks: pieces of one line that was drawn in several.
std::vector<Closure> Joints(const PlanarMap& map, const std::vector<OuterWalk>& walks,
                            double bridge) {
  std::vector<std::pair<const WalkPoint*, std::size_t>> tips;
  for (std::size_t w = 0; w < walks.size(); ++w) {
    for (const WalkPoint& p : walks[w].points) {
      if (p.is_tip) tips.push_back({&p, w});
    }
  }
  std::vector<Closure> joints;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    for (std::size_t j = i + 1; j < tips.size(); ++j) {
      if (tips[i].second == tips[j].second) continue;
      if (const auto score = Score(map, *tips[i].first, *tips[j].first, bridge)) {
        joints.push_back({tips[i].first->position, tips[j].first->position, *score, 0});
      }
    }
  }
  return joints;
}

/// The best slit: two places near each other and far along the walk, that close a face of the
/// animal's size.
std::optional<Closure> BestSlit(const PlanarMap& map, const OuterWalk& walk, double least_area) {
  const double reach = kSlit * map.diagonal;
  std::vector<std::size_t> by_x(walk.points.size());
  for (std::size_t i = 0; i < by_x.size(); ++i) by_x[i] = i;
  std::sort(by_x.begin(), by_x.end(), [&](std::size_t a, std::size_t b) {
    return walk.points[a].position.x() < walk.points[b].position.x();
  });
  std::optional<Closure> best;
  for (std::size_t a = 0; a < by_x.size(); ++a) {
    const WalkPoint& p = walk.points[by_x[a]];
    for (std::size_t b = a + 1; b < by_x.size(); ++b) {
      const WalkPoint& q = walk.points[by_x[b]];
      if (q.position.x() - p.position.x() > reach) break;
      const double distance = (q.position - p.position).norm();
      if (distance == 0 || distance > reach || walk.Along(by_x[a], by_x[b]) < 20 * reach) continue;
      const double area = walk.FaceArea(by_x[a], by_x[b]);
      if (area < least_area || (best && distance >= best->score)) continue;
      best = {p.position, q.position, distance, area};
    }
  }
  return best;
}

/// All closures of a round, best first, each place used once.
std::vector<Closure> FindClosures(const PlanarMap& map, double bridge) {
  const std::vector<OuterWalk> walks = OuterWalks(map, 0.25 * kSlit * map.diagonal);
  std::vector<Closure> found = Joints(map, walks, bridge);
  for (const OuterWalk& walk : walks) {
    for (std::size_t i = 0; i < walk.points.size(); ++i) {
      if (!walk.points[i].is_tip) continue;
      if (const auto closure = BestClosure(map, walk, i, bridge)) found.push_back(*closure);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Closure& a, const Closure& b) { return a.score < b.score; });
  std::vector<Closure> chosen;
  std::set<std::array<double, 2>> used;
  for (const Closure& c : found) {
    const std::array<double, 2> from{c.from.x(), c.from.y()}, to{c.to.x(), c.to.y()};
    if (used.contains(from) || used.contains(to)) continue;
    used.insert(from);
    used.insert(to);
    chosen.push_back(c);
  }
  return chosen;
}

std::vector<Closure> FindSlits(const PlanarMap& map) {
  std::vector<Closure> slits;
  for (const OuterWalk& walk : OuterWalks(map, 0.25 * kSlit * map.diagonal)) {
    if (const auto slit = BestSlit(map, walk, kLeastBodyShare * BoxArea(map)))
      slits.push_back(*slit);
  }
  return slits;
}

Diagnostic Describe(const Closure& closure, const char* code, const char* what, double diagonal) {
  const double percent = 100 * (closure.to - closure.from).norm() / diagonal;
  char text[160];
  std::snprintf(text, sizeof text, "%s of %.2g %% of the drawing's size at (%.5g, %.5g)", what,
                percent, closure.from.x(), closure.from.y());
  return At(Warning(code, text), closure.from);
}

/// One round: the map with the closures drawn in.
Outcome<PlanarMap> Redraw(std::vector<ArrangementLine>& lines, const std::vector<Closure>& closures,
                          double diagonal) {
  for (const Closure& c : closures) lines.push_back({{c.from, c.to}, -1, false, 0});
  return Arrange(lines, diagonal);
}

/// Where the outline is open: the narrowest closure that would enclose an animal, however wide.
Diagnostic OpenOutline(const PlanarMap& map) {
  std::optional<Closure> best;
  for (const double bridge : {0.05, 0.08, 0.12, 0.2, 0.35, 0.7}) {
    for (const OuterWalk& walk : OuterWalks(map, 0.01 * map.diagonal)) {
      for (std::size_t i = 0; i < walk.points.size(); ++i) {
        if (!walk.points[i].is_tip) continue;
        const auto closure = BestClosure(map, walk, i, bridge * map.diagonal);
        if (closure && (!best || closure->area > best->area)) best = closure;
      }
    }
    if (best && best->area > kLeastBodyShare * BoxArea(map)) break;
  }
  if (!best) {
    return Error(FailureKind::kUnderstanding, "outline-open",
                 "no line of the drawing encloses an animal; draw its outline closed");
  }
  char text[200];
  std::snprintf(text, sizeof text,
                "the outline is open between (%.5g, %.5g) and (%.5g, %.5g), %.2g %% of the "
                "drawing's size apart; join the ends",
                best->from.x(), best->from.y(), best->to.x(), best->to.y(),
                100 * (best->to - best->from).norm() / map.diagonal);
  return At(Error(FailureKind::kUnderstanding, "outline-open", text), best->from);
}

}  // namespace

Outcome<PlanarMap> CloseGaps(PlanarMap map, std::vector<ArrangementLine> lines,
                             const BuildPlanarMapOptions& options) {
  Diagnostics log;
  const double least = kLeastBodyShare * BoxArea(map);
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<Closure> closures = FindClosures(map, options.bridge * map.diagonal);
    const bool gaps = !closures.empty();
    if (!gaps && LargestFace(map) < least) closures = FindSlits(map);
    if (closures.empty()) break;
    for (const Closure& c : closures) {
      log.push_back(
          gaps ? Describe(c, "gap-closed", "closed a gap", map.diagonal)
               : Describe(c, "slit-closed", "closed a slit between two lines", map.diagonal));
    }
    auto redrawn = Redraw(lines, closures, map.diagonal).MoveInto(log);
    if (!redrawn) return Outcome<PlanarMap>::Failure(std::move(log));
    map = std::move(*redrawn);
  }
  if (LargestFace(map) < least) {
    log.push_back(OpenOutline(map));
    return Outcome<PlanarMap>::Failure(std::move(log));
  }
  return {std::move(map), std::move(log)};
}

}  // namespace lascaux

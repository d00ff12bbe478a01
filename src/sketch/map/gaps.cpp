#include "sketch/map/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "sketch/map/attach.h"
#include "sketch/map/closures.h"
#include "sketch/map/contacts.h"
#include "sketch/map/enclosure.h"
#include "sketch/map/open_legs.h"
#include "sketch/map/outer_walk.h"
#include "sketch/map/polyline.h"
#include "sketch/map/slit.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A gap below this share of the diagonal is a slip of the pen.
constexpr double kSlip = 0.01;
/// Largest turn between a gap and the lines that it joins, as long as the drawing may be closed.
constexpr double kMaxTurn = std::numbers::pi / 3;
/// In a drawing of an animal at least this share of the lines has an inside beside it (0.79 or more
/// in 50 drawings that are closed as they are meant); the others are whiskers, manes, antlers,
/// tails of one line. Where that is not so, wider gaps are looked for.
constexpr double kLeastCoverage = 0.8;
/// A drawing with more free ends than this is fur or hatching: it is not looked at for wide gaps.
constexpr std::size_t kMostEnds = 400;
/// Lines that run side by side nearer than this may be meant to touch.
constexpr double kSlit = 6e-3;
/// The way around from one side of a slit to the other is at least so many times as long.
constexpr double kSlitLength = 20;
/// The animal fills at least this share of the drawing's bounds, or its outline is open.
constexpr double kLeastBodyShare = 0.08;
/// Slits whose ends are nearer than this share of the drawing are one.
constexpr double kSameSlit = 1e-3;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

/// The map, and the lines that it was arranged from.
struct Working {
  PlanarMap map;
  std::vector<ArrangementLine> lines;
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

std::optional<Slit> FindSlit(const PlanarMap& map) {
  const double reach = kSlit * map.diagonal;
  const SlitSearch search{.reach = reach,
                          .least_along = kSlitLength * reach,
                          .least_area = kLeastBodyShare * BoxArea(map)};
  std::optional<Slit> best;
  for (const OuterWalk& walk : OuterWalks(map, 0.25 * reach)) {
    const auto slit = NarrowestSlit(walk, search);
    if (slit && (!best || slit->width < best->width)) best = slit;
  }
  return best;
}

/// Share of the drawn length that has an inside on at least one side.
double Coverage(const PlanarMap& map) {
  double covered = 0, all = 0;
  for (int e = 0; e < static_cast<int>(map.edges.size()); ++e) {
    const double length = Length(map.edges[Index(e)].points);
    const auto inside = [&](int h) {
      const MapCycle& cycle = map.cycles[Index(map.cycle[Index(h)])];
      return cycle.area > 0 || cycle.inside.has_value();
    };
    all += length;
    if (inside(2 * e) || inside(2 * e + 1)) covered += length;
  }
  return all > 0 ? covered / all : 0;
}

bool EnclosesAnimal(const PlanarMap& map) {
  return LargestFace(map) >= kLeastBodyShare * BoxArea(map) && Coverage(map) >= kLeastCoverage;
}

/// The line of a closure: straight for a slip of the pen, else tangent to what it goes on from, if
/// there is room for that.
Polyline Curve(const PlanarMap& map, const Closure& c) {
  const double chord = c.Length();
  Polyline straight{c.from, c.to};
  if (chord < kSlip * map.diagonal) return straight;
  const Vector2d to_handle = c.to_direction.isZero(0) ? Vector2d((c.from - c.to) / 3)
                                                      : Vector2d(chord / 3 * c.to_direction);
  const CubicBezier cubic{{c.from, c.from + chord / 3 * c.from_direction, c.to + to_handle, c.to}};
  Polyline line;
  constexpr int kPieces = 8;
  for (int i = 0; i <= kPieces; ++i) line.push_back(cubic.At(static_cast<double>(i) / kPieces));
  return line;
}

Diagnostic Describe(const Vector2d& from, const Vector2d& to, const char* code, const char* what,
                    double diagonal) {
  char text[200];
  std::snprintf(text, sizeof text,
                "%s of %.2g %% of the drawing's size between (%.5g, %.5g) and (%.5g, %.5g)", what,
                100 * (to - from).norm() / diagonal, from.x(), from.y(), to.x(), to.y());
  return At(Warning(code, text), 0.5 * (from + to));
}

/// Free ends, inside and outside.
std::size_t FreeEnds(const PlanarMap& map) {
  return static_cast<std::size_t>(
      std::count_if(map.nodes.begin(), map.nodes.end(),
                    [](const MapNode& node) { return node.outgoing.size() == 1; }));
}

/// What it would take to enclose an animal: closures of any width, at ever lower prices until some
/// are worth it.
std::vector<Closure> MissingClosures(const PlanarMap& map,
                                     const std::vector<ArrangementLine>& lines) {
  if (FreeEnds(map) > kMostEnds) return {};
  constexpr std::array<std::array<double, 2>, 5> kReachAndPrice{
      {{0.15, 1}, {0.25, 1}, {0.25, 0.25}, {0.4, 0.25}, {0.7, 0.05}}};
  for (const auto& [reach, price] : kReachAndPrice) {
    std::vector<Closure> found =
        FindClosures(map, {.reach = reach * map.diagonal, .max_turn = std::numbers::pi});
    for (Closure& c : found) c.price *= price;
    const auto chosen = ChooseClosures(lines, found, map.diagonal);
    if (!chosen || chosen->empty()) continue;
    std::vector<Closure> missing;
    for (const std::size_t i : *chosen) missing.push_back(found[i]);
    return missing;
  }
  return {};
}

/// Where the outline is open: the widest of the closures that would enclose an animal.
Diagnostic OpenOutline(const PlanarMap& map, const std::vector<ArrangementLine>& lines) {
  const std::vector<Closure> missing = MissingClosures(map, lines);
  if (missing.empty()) {
    return Error(FailureKind::kUnderstanding, "outline-open",
                 "no line of the drawing encloses an animal; draw its outline closed");
  }
  const Closure& widest =
      *std::max_element(missing.begin(), missing.end(),
                        [](const Closure& a, const Closure& b) { return a.Length() < b.Length(); });
  const std::string where =
      missing.size() == 1 ? "open"
                          : "open in " + std::to_string(missing.size()) + " places, the widest";
  char text[240];
  std::snprintf(text, sizeof text,
                "the outline is %s between (%.5g, %.5g) and (%.5g, %.5g), %.2g %% of the drawing's "
                "size apart; join the ends",
                where.c_str(), widest.from.x(), widest.from.y(), widest.to.x(), widest.to.y(),
                100 * widest.Length() / map.diagonal);
  return At(Error(FailureKind::kUnderstanding, "outline-open", text), widest.from);
}

/// Draws closures into the map, with a warning for each; their number.
Outcome<int> Draw(Working& work, const std::vector<Closure>& closures) {
  Diagnostics log;
  if (closures.empty()) return 0;
  for (const Closure& c : closures) {
    work.lines.push_back({Curve(work.map, c), -1, false, 0});
    log.push_back(Describe(c.from, c.to, "gap-closed", "closed a gap", work.map.diagonal));
  }
  auto redrawn = Arrange(work.lines, work.map.diagonal).MoveInto(log);
  if (!redrawn) return Outcome<int>::Failure(std::move(log));
  work.map = std::move(*redrawn);
  return {static_cast<int>(closures.size()), std::move(log)};
}

/// What may close the outline within the search.
std::vector<Closure> Candidates(const PlanarMap& map, const ClosureSearch& search) {
  std::vector<Closure> candidates = FindClosures(map, search);
  for (const Closure& contact : FindContacts(map)) candidates.push_back(contact);
  return candidates;
}

/// Draws those closures that are worth it together; their number.
Outcome<int> DrawBest(Working& work, const std::vector<Closure>& found) {
  if (found.empty()) return 0;
  Diagnostics log;
  const auto chosen = ChooseClosures(work.lines, found, work.map.diagonal).MoveInto(log);
  if (!chosen) return Outcome<int>::Failure(std::move(log));
  std::vector<Closure> closures;
  for (const std::size_t i : *chosen) closures.push_back(found[i]);
  return Draw(work, closures);
}

}  // namespace

Outcome<PlanarMap> CloseGaps(PlanarMap map, std::vector<ArrangementLine> lines,
                             const BuildPlanarMapOptions& options) {
  using Result = Outcome<PlanarMap>;
  Diagnostics log;
  Working work{std::move(map), std::move(lines)};
  const double size = work.map.diagonal;
  const ClosureSearch narrow{.reach = options.bridge * size, .max_turn = kMaxTurn};
  if (!DrawBest(work, Candidates(work.map, narrow)).MoveInto(log))
    return Result::Failure(std::move(log));
  if (FreeEnds(work.map) <= kMostEnds && !EnclosesAnimal(work.map)) {
    const ClosureSearch wide{.reach = options.bridge_max * size, .max_turn = std::numbers::pi};
    if (!DrawBest(work, Candidates(work.map, wide)).MoveInto(log))
      return Result::Failure(std::move(log));
  }
  const double least = kLeastBodyShare * BoxArea(work.map);
  std::vector<Slit> closed;
  while (LargestFace(work.map) < least) {
    const auto slit = FindSlit(work.map);
    // One that closing did not close would be found for ever.
    if (!slit || std::any_of(closed.begin(), closed.end(), [&](const Slit& other) {
          return (slit->from - other.from).norm() + (slit->to - other.to).norm() < kSameSlit * size;
        }))
      break;
    closed.push_back(*slit);
    log.push_back(
        Describe(slit->from, slit->to, "slit-closed", "closed a slit between two lines", size));
    work.lines.push_back({{slit->from, slit->to}, -1, false, 0});
    auto redrawn = Arrange(work.lines, size).MoveInto(log);
    if (!redrawn) return Result::Failure(std::move(log));
    work.map = std::move(*redrawn);
  }
  if (!DrawBest(work, FindOpenLegs(work.map, options.bridge_max * size)).MoveInto(log))
    return Result::Failure(std::move(log));
  if (!Draw(work, FindAttachments(work.map)).MoveInto(log)) return Result::Failure(std::move(log));
  if (LargestFace(work.map) < least) {
    log.push_back(OpenOutline(work.map, work.lines));
    return Result::Failure(std::move(log));
  }
  return {std::move(work.map), std::move(log)};
}

}  // namespace lascaux

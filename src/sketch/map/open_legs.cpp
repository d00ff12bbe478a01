#include "sketch/map/open_legs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "lascaux/sketch/parts.h"
#include "sketch/map/heights.h"
#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A leg begins below this share of the drawing's height (tails and manes begin above) ...
constexpr double kRoot = 0.4;
/// ... comes down to the lowest part of it, ...
constexpr double kGround = 0.35;
/// ... and is this long, as a share of the diagonal: less is a toe.
constexpr double kShortest = 0.06;
/// At its other end, the foot's, the line no longer runs down: it is at least so far from that
/// direction.
constexpr double kFootTurn = std::numbers::pi / 4;
/// Largest turns between the line and what it is joined by: at the top the flank runs on, behind
/// the foot the near leg hides a line that may go any way but back.
constexpr double kTopTurn = std::numbers::pi / 3, kBackTurn = 1.75;
/// What is enclosed is as wide, on average, as this share of the diagonal, and as this share of its
/// height at most: else it is a hair, or the gap between two legs.
constexpr double kLeastWidth = 0.012, kMostWidth = 0.7;

/// A line on the outside that ends freely: from its upper end to its lower one.
struct OpenLine {
  Polyline points;
  std::optional<int> top, foot;  ///< the half-edge that begins at a free end
};

bool IsOutside(const PlanarMap& map, int h) {
  const auto kind = [&](int k) {
    return map.cycles[static_cast<std::size_t>(map.cycle[static_cast<std::size_t>(k)])].kind;
  };
  return kind(h) == CycleKind::kOuter && kind(PlanarMap::Twin(h)) == CycleKind::kOuter;
}

/// The line from a free end to the next place where lines meet or end; none for the second end of a
/// line that is free at both.
std::optional<OpenLine> LineFrom(const PlanarMap& map, int start) {
  OpenLine line;
  int h = start;
  while (true) {
    Append(line.points, map.Points(h));
    const auto& next = map.nodes[static_cast<std::size_t>(map.Target(h))].outgoing;
    if (next.size() == 2) {
      h = next[0] == PlanarMap::Twin(h) ? next[1] : next[0];
      continue;
    }
    line.top = start;
    if (next.size() == 1) line.foot = PlanarMap::Twin(h);
    break;
  }
  if (line.foot && *line.foot < start) return std::nullopt;
  if (line.points.front().y() > line.points.back().y()) {
    std::reverse(line.points.begin(), line.points.end());
    std::swap(line.top, line.foot);
  }
  return line;
}

/// True when the line runs down to the ground and turns there.
bool HasFlankAndFoot(const PlanarMap& map, const OpenLine& line, const Heights& range) {
  const double top = line.points.front().y();
  double lowest = top;
  for (const Vector2d& p : line.points) lowest = std::max(lowest, p.y());
  const double height = range.bottom - range.top, own = lowest - top;
  if (top < range.top + kRoot * height || lowest < range.bottom - kGround * height) return false;
  if (own < kShortest * map.diagonal) return false;
  const Vector2d way = ArrivalDirection(line.points, 0.01 * map.diagonal);
  return AngleBetween(way, Vector2d(0, 1)) > kFootTurn;
}

/// The cheapest closure from a free end that turns by `most` at the line's own side.
std::optional<Closure> Cheapest(const std::vector<Closure>& closures, int half_edge, double most) {
  std::optional<Closure> best;
  for (const Closure& c : closures) {
    if (c.half_edge != half_edge || (best && c.price >= best->price)) continue;
    if (AngleBetween(c.from_direction, c.to - c.from) <= most) best = c;
  }
  return best;
}

/// True when the line with its closures encloses a leg: neither a hair nor the way between legs.
bool EnclosesLeg(const PlanarMap& map, Polyline ring, const std::array<Vector2d, 2>& ends) {
  ring.insert(ring.begin(), ends[0]);
  ring.push_back(ends[1]);
  const auto [low, high] = std::minmax_element(
      ring.begin(), ring.end(), [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); });
  const double height = high->y() - low->y();
  const double width = std::abs(SignedArea(ring)) / height;
  return width >= kLeastWidth * map.diagonal && width <= kMostWidth * height;
}

}  // namespace

std::vector<Closure> FindOpenLegs(const PlanarMap& map, double reach) {
  if (map.nodes.empty()) return {};
  const Heights range = HeightsOf(map);
  std::vector<OpenLine> lines;
  for (const MapNode& node : map.nodes) {
    if (node.outgoing.size() != 1 || !IsOutside(map, node.outgoing.front())) continue;
    auto line = LineFrom(map, node.outgoing.front());
    if (line && HasFlankAndFoot(map, *line, range)) lines.push_back(std::move(*line));
  }
  std::vector<Closure> chosen;
  if (lines.empty()) return chosen;
  const std::vector<Closure> closures =
      FindClosures(map, {.reach = reach, .max_turn = std::numbers::pi});
  for (const OpenLine& line : lines) {
    const auto top = line.top ? Cheapest(closures, *line.top, kTopTurn) : std::nullopt;
    const auto foot = line.foot ? Cheapest(closures, *line.foot, kBackTurn) : std::nullopt;
    if ((line.top && !top) || (line.foot && !foot)) continue;
    if (!EnclosesLeg(map, line.points,
                     {top ? top->to : line.points.front(), foot ? foot->to : line.points.back()}))
      continue;
    if (top) chosen.push_back(*top);
    if (foot) chosen.push_back(*foot);
  }
  for (Closure& c : chosen) c.price = 0;
  return chosen;
}

}  // namespace lascaux

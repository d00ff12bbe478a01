#include "sketch/map/attach.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

/// An end this near to the line that it points at was meant to reach it: twice the radius in which
/// ends snap whichever way they point.
constexpr double kSlip = 0.01;
constexpr double kSlipTurn = std::numbers::pi / 5;
/// Two ends that point at each other are a line that has a gap. Those of a limb's two curves, whose
/// arch is as wide as a gap of this share, turn more.
constexpr double kBroken = 0.03;
constexpr double kBrokenTurn = std::numbers::pi / 12;
/// The better end of a path that is free at both.
constexpr double kLoose = 0.025;
constexpr double kLooseTurn = std::numbers::pi / 3;
/// How many gaps long such paths are at least (of a line that has a gap one of the two), and those
/// that are free at both ends of which share of the diagonal: shorter ones are eyes and wrinkles.
constexpr double kGaps = 4;
constexpr double kShortest = 0.05;

/// The way from a free end to the next place where lines meet or end.
struct Path {
  int end = 0;  ///< its last half-edge
  double length = 0;
  bool is_loose = false;  ///< it ends freely, too
};

Path PathFrom(const PlanarMap& map, int half_edge) {
  Path path;
  int h = half_edge;
  while (true) {
    path.length += Length(map.edges[static_cast<std::size_t>(h / 2)].points);
    path.end = h;
    const auto& next = map.nodes[static_cast<std::size_t>(map.Target(h))].outgoing;
    if (next.size() != 2) {
      path.is_loose = next.size() == 1;
      return path;
    }
    h = next[0] == PlanarMap::Twin(h) ? next[1] : next[0];
  }
}

}  // namespace

std::vector<Closure> FindAttachments(const PlanarMap& map) {
  const double size = map.diagonal;
  std::vector<Closure> chosen;
  std::map<int, Closure> best_of_loose;  // by the lesser edge at the path's two ends
  std::set<std::array<double, 2>> joined;
  std::optional<int> tip;
  for (const Closure& c : FindClosures(
           map, {.side = ClosureSide::kInside, .reach = kBroken * size, .max_turn = kLooseTurn})) {
    const Path path = PathFrom(map, c.half_edge);
    if (!c.to_direction.isZero(0) && c.turn <= kBrokenTurn && path.length >= kGaps * c.Length()) {
      // Each such closure is found from both of its ends.
      const bool is_new = joined.insert({c.from.x(), c.from.y()}).second;
      if (is_new && joined.insert({c.to.x(), c.to.y()}).second) chosen.push_back(c);
      continue;
    }
    if (c.Length() > kLoose * size) continue;
    const bool is_slip = c.Length() <= kSlip * size && c.turn <= kSlipTurn;
    if (!path.is_loose) {
      // The tips of a limb's two curves don't meet: it would be cut off.
      const bool meets_line = c.to_direction.isZero(0);
      if (is_slip && meets_line && tip != c.half_edge) chosen.push_back(c);
      if (is_slip && meets_line) tip = c.half_edge;
      continue;
    }
    if (path.length < kShortest * size || path.length < kGaps * c.Length()) continue;
    const int key = std::min(c.half_edge / 2, path.end / 2);
    const auto [entry, is_new] = best_of_loose.try_emplace(key, c);
    if (!is_new && c.price < entry->second.price) entry->second = c;
  }
  for (const auto& [path, closure] : best_of_loose) chosen.push_back(closure);
  return chosen;
}

}  // namespace lascaux

#include "sketch/map/cells.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "sketch/map/arrangement.h"
#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

/// A border cell below this share of the animal's area is a detail: in real drawings hooves and
/// toes lie below it, the smallest ears, horns and tails above.
constexpr double kCrumb = 3.5e-3;

/// A hoof is a border cell that hangs on one other, from a line above it that is longer than it
/// reaches down, in the lowest part of the drawing (share of its height), and has at most this
/// share of the animal's area. It is no far side of its own leg; legs are longer than their joints.
constexpr double kFeet = 0.15, kMostHoof = 0.015;
/// Above it the leg goes up on both sides, by at least this sine over as long a way as the hoof is
/// wide.
constexpr double kSteep = 0.5;
/// Lines that a hand joins are not quite even: the hoof may reach up beside the line above it, by
/// this share of its length.
constexpr double kUneven = 0.1;

double AnimalArea(const PlanarMap& map) {
  double sum = 0;
  for (const MapCycle& cycle : map.cycles) {
    if (cycle.kind == CycleKind::kBorder || cycle.kind == CycleKind::kOther) sum += cycle.area;
  }
  return sum;
}

/// Lengths of what a cycle shares with each bounded cycle beside it.
std::map<int, double> Neighbours(const PlanarMap& map, int cycle) {
  std::map<int, double> shared;
  for (const int h : map.cycles[static_cast<std::size_t>(cycle)].half_edges) {
    const int other = map.cycle[static_cast<std::size_t>(PlanarMap::Twin(h))];
    if (other == cycle || map.cycles[static_cast<std::size_t>(other)].area <= 0) continue;
    shared[other] += Length(map.edges[static_cast<std::size_t>(h / 2)].points);
  }
  return shared;
}

/// The bounded cycle that shares the longest line with `cycle`.
std::optional<int> LongestNeighbour(const PlanarMap& map, int cycle) {
  const std::map<int, double> shared = Neighbours(map, cycle);
  const auto longest =
      std::max_element(shared.begin(), shared.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return longest == shared.end() ? std::nullopt : std::optional(longest->first);
}

/// How far down something reaches on the page: y grows downwards.
struct Extent {
  double top = std::numeric_limits<double>::infinity(), bottom = -top;

  void Add(const Polyline& line) {
    for (const auto& p : line) {
      top = std::min(top, p.y());
      bottom = std::max(bottom, p.y());
    }
  }
};

bool IsOutside(const PlanarMap& map, int h) {
  const int cycle = map.cycle[static_cast<std::size_t>(PlanarMap::Twin(h))];
  return map.cycles[static_cast<std::size_t>(cycle)].area <= 0;
}

/// True when the outline runs upwards from both ends of the line that two cells share, along the
/// upper one, for `reach`: a leg ends there.
bool EndsALeg(const PlanarMap& map, int cell, int leg, double reach) {
  std::set<int> joint;
  for (const int h : map.cycles[static_cast<std::size_t>(cell)].half_edges) {
    if (!IsOutside(map, h)) joint.insert({map.Origin(h), map.Target(h)});
  }
  int sides = 0;
  for (const int h : map.cycles[static_cast<std::size_t>(leg)].half_edges) {
    if (!IsOutside(map, h)) continue;
    const Polyline line = map.Points(h);
    if (joint.contains(map.Origin(h)) && DepartureDirection(line, reach).y() < -kSteep) ++sides;
    if (joint.contains(map.Target(h)) && ArrivalDirection(line, reach).y() > kSteep) ++sides;
  }
  return sides == 2;
}

bool IsHoof(const PlanarMap& map, int cycle, double animal) {
  const MapCycle& cell = map.cycles[static_cast<std::size_t>(cycle)];
  const std::map<int, double> beside = Neighbours(map, cycle);
  if (cell.area > kMostHoof * animal || beside.size() != 1) return false;
  Extent page, free, joint;
  for (const MapEdge& edge : map.edges) page.Add(edge.points);
  for (const int h : cell.half_edges)
    (IsOutside(map, h) ? free : joint).Add(map.edges[static_cast<std::size_t>(h / 2)].points);
  const double lowest = page.bottom - kFeet * (page.bottom - page.top);
  const double length = free.bottom - joint.bottom, width = beside.begin()->second;
  return free.top >= joint.top - kUneven * length && length > 0 && length < width &&
         joint.top > lowest && EndsALeg(map, cycle, beside.begin()->first, width);
}

/// The smallest cell that is to be merged and has a neighbour.
std::optional<std::pair<int, int>> NextMerge(const PlanarMap& map, double animal) {
  std::optional<std::pair<int, int>> best;
  for (int c = 0; c < static_cast<int>(map.cycles.size()); ++c) {
    const MapCycle& cycle = map.cycles[static_cast<std::size_t>(c)];
    const bool enclosed = cycle.kind == CycleKind::kOther;
    const bool small = cycle.kind == CycleKind::kBorder &&
                       (cycle.area < kCrumb * animal || IsHoof(map, c, animal));
    if (!enclosed && !small) continue;
    if (best && cycle.area >= map.cycles[static_cast<std::size_t>(best->first)].area) continue;
    if (const auto neighbour = LongestNeighbour(map, c)) best = {c, *neighbour};
  }
  return best;
}

}  // namespace

Outcome<PlanarMap> MergeCells(PlanarMap map) {
  Diagnostics log;
  const double animal = AnimalArea(map);
  while (const auto merge = NextMerge(map, animal)) {
    const auto [cell, neighbour] = *merge;
    std::vector<bool> drop(map.edges.size(), false);
    for (const int h : map.cycles[static_cast<std::size_t>(cell)].half_edges) {
      drop[static_cast<std::size_t>(h / 2)] =
          map.cycle[static_cast<std::size_t>(PlanarMap::Twin(h))] == neighbour;
    }
    const int first = map.cycles[static_cast<std::size_t>(cell)].half_edges.front();
    log.push_back(At(Note("cell-merged", "a small cell was merged with the part beside it"),
                     map.nodes[static_cast<std::size_t>(map.Origin(first))].position));
    map = WithoutEdges(map, drop);
  }
  return {std::move(map), std::move(log)};
}

}  // namespace lascaux

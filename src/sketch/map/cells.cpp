#include "sketch/map/cells.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "sketch/map/arrangement.h"
#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

/// A border cell below this share of the animal's area is a detail: in real drawings hooves and
/// toes lie below it, the smallest ears, horns and tails above.
constexpr double kCrumb = 3.5e-3;

double AnimalArea(const PlanarMap& map) {
  double sum = 0;
  for (const MapCycle& cycle : map.cycles) {
    if (cycle.kind == CycleKind::kBorder || cycle.kind == CycleKind::kOther) sum += cycle.area;
  }
  return sum;
}

/// The bounded cycle that shares the longest line with `cycle`.
std::optional<int> LongestNeighbour(const PlanarMap& map, int cycle) {
  std::map<int, double> shared;
  for (const int h : map.cycles[static_cast<std::size_t>(cycle)].half_edges) {
    const int other = map.cycle[static_cast<std::size_t>(PlanarMap::Twin(h))];
    if (other == cycle || map.cycles[static_cast<std::size_t>(other)].area <= 0) continue;
    shared[other] += Length(map.edges[static_cast<std::size_t>(h / 2)].points);
  }
  const auto longest =
      std::max_element(shared.begin(), shared.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return longest == shared.end() ? std::nullopt : std::optional(longest->first);
}

/// The smallest cell that is to be merged and has a neighbour.
std::optional<std::pair<int, int>> NextMerge(const PlanarMap& map, double crumb) {
  std::optional<std::pair<int, int>> best;
  for (int c = 0; c < static_cast<int>(map.cycles.size()); ++c) {
    const MapCycle& cycle = map.cycles[static_cast<std::size_t>(c)];
    const bool enclosed = cycle.kind == CycleKind::kOther;
    const bool crumb_cell = cycle.kind == CycleKind::kBorder && cycle.area < crumb;
    if (!enclosed && !crumb_cell) continue;
    if (best && cycle.area >= map.cycles[static_cast<std::size_t>(best->first)].area) continue;
    if (const auto neighbour = LongestNeighbour(map, c)) best = {c, *neighbour};
  }
  return best;
}

}  // namespace

Outcome<PlanarMap> MergeCells(PlanarMap map) {
  Diagnostics log;
  const double crumb = kCrumb * AnimalArea(map);
  while (const auto merge = NextMerge(map, crumb)) {
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

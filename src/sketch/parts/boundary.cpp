#include "sketch/parts/boundary.h"

#include <algorithm>

namespace lascaux {
namespace {

bool IsInner(const PlanarMap& map, int h) {
  return map.cycle[static_cast<std::size_t>(h)] ==
         map.cycle[static_cast<std::size_t>(PlanarMap::Twin(h))];
}

/// The path from the root of a dangling tree to the tip that is farthest along it. `run` walks
/// around the tree.
std::vector<int> LongestPath(const PlanarMap& map, const std::vector<int>& run) {
  std::vector<int> path, best;
  double length = 0, longest = -1;
  for (const int h : run) {
    const double step = Length(map.edges[static_cast<std::size_t>(h / 2)].points);
    if (!path.empty() && path.back() == PlanarMap::Twin(h)) {
      path.pop_back();
      length -= step;
      continue;
    }
    path.push_back(h);
    length += step;
    const bool tip = map.nodes[static_cast<std::size_t>(map.Target(h))].outgoing.size() == 1;
    if (tip && length > longest) {
      longest = length;
      best = path;
    }
  }
  return best;
}

}  // namespace

Boundary BoundaryOf(const PlanarMap& map, int cycle) {
  const std::vector<int>& walk = map.cycles[static_cast<std::size_t>(cycle)].half_edges;
  const int n = static_cast<int>(walk.size());
  Boundary boundary;
  int start = 0;
  while (start < n && IsInner(map, walk[static_cast<std::size_t>(start)])) ++start;
  std::vector<int> run;
  for (int k = 0; k < n; ++k) {
    const int h = walk[static_cast<std::size_t>((start + k) % n)];
    if (!IsInner(map, h)) {
      boundary.half_edges.push_back(h);
      continue;
    }
    run.push_back(h);
    // Back at the root: one tree is walked around. A bridge to another loop never comes back this
    // way and gives no path.
    if (map.Target(h) != map.Origin(run.front())) continue;
    const std::vector<int> path = LongestPath(map, run);
    run.clear();
    if (path.empty()) continue;
    DanglingPath hanging;
    for (const int p : path) {
      Append(hanging.points, map.Points(p));
      hanging.edges.push_back(p / 2);
    }
    hanging.position = static_cast<int>(boundary.half_edges.size());
    boundary.paths.push_back(std::move(hanging));
  }
  // Those at the very end of the walk hang on its first node.
  const int around = std::max(1, static_cast<int>(boundary.half_edges.size()));
  for (DanglingPath& path : boundary.paths) path.position %= around;
  return boundary;
}

}  // namespace lascaux

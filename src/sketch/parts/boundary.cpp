#include "sketch/parts/boundary.h"

#include <algorithm>

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Tangents of a curve are taken over this share of the diagonal: longer than a hook of the pen, shorter than a bend.
constexpr double kTangentReach = 0.012;

bool IsInner(const PlanarMap& map, int h) {
  return map.cycle[static_cast<std::size_t>(h)] == map.cycle[static_cast<std::size_t>(PlanarMap::Twin(h))];
}

/// The path from the root of a dangling tree to the tip that is farthest along it. `run` walks around the tree.
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

/// The direction in which the walk arrives at its half-edge `k`, and in which it goes on, over the tangent reach.
Vector2d ArrivalAt(const PlanarMap& map, const Boundary& boundary, int k) {
  Polyline line;
  for (int back = 1; back <= boundary.size() && Length(line) < kTangentReach * map.diagonal; ++back) {
    Polyline longer = map.Points(boundary.half_edges[static_cast<std::size_t>((k - back + boundary.size()) % boundary.size())]);
    Append(longer, line);
    line = std::move(longer);
  }
  return ArrivalDirection(line, kTangentReach * map.diagonal);
}

Vector2d DepartureAt(const PlanarMap& map, const Boundary& boundary, int k) {
  Polyline line;
  for (int on = 0; on < boundary.size() && Length(line) < kTangentReach * map.diagonal; ++on) {
    Append(line, map.Points(boundary.half_edges[static_cast<std::size_t>((k + on) % boundary.size())]));
  }
  return DepartureDirection(line, kTangentReach * map.diagonal);
}

void Measure(const PlanarMap& map, const Boundary& boundary, SuggestiveCurve& curve) {
  const double reach = kTangentReach * map.diagonal;
  curve.length = Length(curve.points);
  curve.departure = DepartureDirection(curve.points, reach);
  curve.tip = ArrivalDirection(curve.points, reach);
  const Vector2d before = ArrivalAt(map, boundary, curve.position);
  const Vector2d after = DepartureAt(map, boundary, curve.position);
  curve.turn_before = AngleBetween(before, curve.departure);
  curve.turn_after = AngleBetween(-after, curve.departure);
  curve.turn_through = AngleBetween(before, after);
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
    // Back at the root: one tree is walked around. A bridge to another loop never comes back this way and gives no path.
    if (map.Target(h) != map.Origin(run.front())) continue;
    const std::vector<int> path = LongestPath(map, run);
    run.clear();
    if (path.empty()) continue;
    SuggestiveCurve curve;
    for (const int p : path) {
      Append(curve.points, map.Points(p));
      curve.edges.push_back(p / 2);
    }
    curve.position = boundary.size();
    boundary.curves.push_back(std::move(curve));
  }
  for (SuggestiveCurve& curve : boundary.curves) {
    curve.position %= std::max(1, boundary.size());
    Measure(map, boundary, curve);
  }
  // Those at the very end of the list belong to the walk's first node.
  std::stable_sort(boundary.curves.begin(), boundary.curves.end(),
                   [](const SuggestiveCurve& a, const SuggestiveCurve& b) { return a.position < b.position; });
  return boundary;
}

Polyline WalkPoints(const PlanarMap& map, const Boundary& boundary, int from, int to) {
  Polyline line;
  const int n = boundary.size();
  int k = from;
  do {
    Append(line, map.Points(boundary.half_edges[static_cast<std::size_t>(k)]));
    k = (k + 1) % n;
  } while (k != to);
  return line;
}

}  // namespace lascaux

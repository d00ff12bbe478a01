#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "lascaux/sketch/parts.h"
#include "sketch/map/arrangement.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

/// Sorts the half-edges around each node by angle. Where first segments leave in one direction (a
/// cusp), the next points along decide, as curvature would.
void SortAroundNodes(PlanarMap& map) {
  for (MapNode& node : map.nodes) node.outgoing.clear();
  for (int h = 0; h < static_cast<int>(2 * map.edges.size()); ++h) {
    map.nodes[Index(map.Origin(h))].outgoing.push_back(h);
  }
  const auto point = [&](int h, std::size_t k) -> const Vector2d& {
    const auto& points = map.edges[Index(h / 2)].points;
    k = std::min(k, points.size() - 1);
    return h % 2 == 0 ? points[k] : points[points.size() - 1 - k];
  };
  for (MapNode& node : map.nodes) {
    const auto angle = [&](int h, std::size_t k) {
      const Vector2d d = point(h, k) - node.position;
      return std::atan2(d.y(), d.x());
    };
    std::sort(node.outgoing.begin(), node.outgoing.end(), [&](int g, int h) {
      constexpr std::size_t kLookAhead = 8;
      constexpr double kSameDirection = 1e-9;
      for (std::size_t k = 1; k < kLookAhead; ++k) {
        const double a = angle(g, k), b = angle(h, k);
        if (std::abs(a - b) > kSameDirection) return a < b;
      }
      return g < h;
    });
  }
}

void LinkNext(PlanarMap& map) {
  map.next.assign(2 * map.edges.size(), -1);
  for (const MapNode& node : map.nodes) {
    const std::size_t n = node.outgoing.size();
    for (std::size_t k = 0; k < n; ++k) {
      // Arriving against outgoing[k], leave by the one before it: the smallest turn that keeps the
      // face on its side.
      map.next[Index(PlanarMap::Twin(node.outgoing[k]))] = node.outgoing[(k + n - 1) % n];
    }
  }
}

double TwiceArea(const PlanarMap& map, int half_edge) {
  const auto& points = map.edges[Index(half_edge / 2)].points;
  const Vector2d& origin = map.nodes.front().position;
  double sum = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Vector2d a = points[k - 1] - origin, b = points[k] - origin;
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return half_edge % 2 == 0 ? sum : -sum;
}

void WalkCycles(PlanarMap& map) {
  map.cycle.assign(map.next.size(), -1);
  map.cycles.clear();
  for (int start = 0; start < static_cast<int>(map.next.size()); ++start) {
    if (map.cycle[Index(start)] >= 0) continue;
    MapCycle cycle;
    for (int h = start; map.cycle[Index(h)] < 0; h = map.next[Index(h)]) {
      map.cycle[Index(h)] = static_cast<int>(map.cycles.size());
      cycle.half_edges.push_back(h);
      cycle.area += 0.5 * TwiceArea(map, h);
    }
    map.cycles.push_back(std::move(cycle));
  }
}

/// Connected components of the map, as the smallest node of each.
std::vector<int> Components(const PlanarMap& map) {
  std::vector<int> parent(map.nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  const std::function<int(int)> root = [&](int i) {
    while (parent[Index(i)] != i) i = parent[Index(i)] = parent[Index(parent[Index(i)])];
    return i;
  };
  for (const MapEdge& edge : map.edges) {
    const int a = root(edge.nodes[0]), b = root(edge.nodes[1]);
    parent[Index(std::max(a, b))] = std::min(a, b);
  }
  for (int i = 0; i < static_cast<int>(parent.size()); ++i) parent[Index(i)] = root(i);
  return parent;
}

/// The smallest bounded cycle of another component around `point`.
std::optional<int> EnclosingCycle(const PlanarMap& map, const std::vector<int>& component, int self,
                                  const std::vector<Polyline>& rings,
                                  const std::vector<Eigen::AlignedBox2d>& boxes,
                                  const Vector2d& point) {
  std::optional<int> best;
  for (int c = 0; c < static_cast<int>(map.cycles.size()); ++c) {
    const MapCycle& cycle = map.cycles[Index(c)];
    if (cycle.area <= 0 || component[Index(map.Origin(cycle.half_edges.front()))] == self) continue;
    if (!boxes[Index(c)].contains(point) || (best && cycle.area >= map.cycles[Index(*best)].area))
      continue;
    if (Contains(rings[Index(c)], point)) best = c;
  }
  return best;
}

void Classify(PlanarMap& map) {
  const std::vector<int> component = Components(map);
  std::vector<Polyline> rings(map.cycles.size());
  std::vector<Eigen::AlignedBox2d> boxes(map.cycles.size());
  for (std::size_t c = 0; c < map.cycles.size(); ++c) {
    if (map.cycles[c].area <= 0) continue;
    for (const int h : map.cycles[c].half_edges) Append(rings[c], map.Points(h));
    for (const Vector2d& p : rings[c]) boxes[c].extend(p);
  }
  std::vector<bool> is_inside(map.nodes.size(), false);
  std::vector<std::optional<int>> enclosing(map.nodes.size());
  for (MapCycle& cycle : map.cycles) {
    if (cycle.area > 0) continue;
    const int node = map.Origin(cycle.half_edges.front());
    const int self = component[Index(node)];
    cycle.inside =
        EnclosingCycle(map, component, self, rings, boxes, map.nodes[Index(node)].position);
    cycle.kind = cycle.inside ? CycleKind::kHole : CycleKind::kOuter;
    is_inside[Index(self)] = cycle.inside.has_value();
    enclosing[Index(self)] = cycle.inside;
  }
  for (MapCycle& cycle : map.cycles) {
    if (cycle.area <= 0) continue;
    const auto outside = std::any_of(cycle.half_edges.begin(), cycle.half_edges.end(), [&](int h) {
      return map.cycles[Index(map.cycle[Index(PlanarMap::Twin(h))])].area <= 0;
    });
    const int self = component[Index(map.Origin(cycle.half_edges.front()))];
    cycle.kind = !outside                 ? CycleKind::kOther
                 : is_inside[Index(self)] ? CycleKind::kIsland
                                          : CycleKind::kBorder;
    if (cycle.kind == CycleKind::kIsland) cycle.inside = enclosing[Index(self)];
  }
}

}  // namespace

PlanarMap TraceCycles(PlanarMap map) {
  const double reach = 4e-3 * map.diagonal;
  for (MapEdge& edge : map.edges) {
    edge.start_tangent = DepartureDirection(edge.points, reach);
    edge.end_tangent = ArrivalDirection(edge.points, reach);
  }
  SortAroundNodes(map);
  LinkNext(map);
  WalkCycles(map);
  Classify(map);
  return map;
}

PlanarMap WithoutEdges(const PlanarMap& map, const std::vector<bool>& drop) {
  PlanarMap result;
  result.diagonal = map.diagonal;
  std::vector<int> node_of(map.nodes.size(), -1);
  for (std::size_t e = 0; e < map.edges.size(); ++e) {
    if (drop[e]) continue;
    MapEdge edge = map.edges[e];
    for (int& node : edge.nodes) {
      int& mapped = node_of[Index(node)];
      if (mapped < 0) {
        mapped = static_cast<int>(result.nodes.size());
        result.nodes.push_back({map.nodes[Index(node)].position, {}});
      }
      node = mapped;
    }
    result.edges.push_back(std::move(edge));
  }
  return TraceCycles(std::move(result));
}

}  // namespace lascaux

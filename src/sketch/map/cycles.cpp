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
  // A tree has no inside; what the sum leaves there is rounding.
  for (MapCycle& cycle : map.cycles) {
    const bool tree = std::all_of(cycle.half_edges.begin(), cycle.half_edges.end(), [&](int h) {
      return map.cycle[Index(PlanarMap::Twin(h))] == map.cycle[Index(h)];
    });
    if (tree) cycle.area = 0;
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

/// The bounded faces of a map by ascending area, so that the first around a point is the innermost.
class Faces {
 public:
  Faces(const PlanarMap& map, const std::vector<int>& component) {
    for (std::size_t c = 0; c < map.cycles.size(); ++c) {
      const MapCycle& cycle = map.cycles[c];
      if (cycle.area <= 0) continue;
      Face face{static_cast<int>(c),
                component[Index(map.Origin(cycle.half_edges.front()))],
                cycle.area,
                {},
                {}};
      for (const int h : cycle.half_edges) Append(face.ring, map.Points(h));
      for (const Vector2d& p : face.ring) face.box.extend(p);
      faces_.push_back(std::move(face));
    }
    std::stable_sort(faces_.begin(), faces_.end(),
                     [](const Face& a, const Face& b) { return a.area < b.area; });
  }

  /// The smallest face around `point` that does not belong to `component`.
  std::optional<int> Around(const Vector2d& point, int component) const {
    for (const Face& face : faces_) {
      if (face.component != component && face.box.contains(point) && Contains(face.ring, point))
        return face.cycle;
    }
    return std::nullopt;
  }

 private:
  struct Face {
    int cycle = 0, component = 0;
    double area = 0;
    Polyline ring;
    Eigen::AlignedBox2d box;
  };
  std::vector<Face> faces_;
};

void Classify(PlanarMap& map) {
  const std::vector<int> component = Components(map);
  const Faces faces(map, component);
  std::vector<std::optional<int>> enclosing(map.nodes.size());
  for (MapCycle& cycle : map.cycles) {
    if (cycle.area > 0) continue;
    const int node = map.Origin(cycle.half_edges.front());
    const int self = component[Index(node)];
    cycle.inside = faces.Around(map.nodes[Index(node)].position, self);
    cycle.kind = cycle.inside ? CycleKind::kHole : CycleKind::kOuter;
    enclosing[Index(self)] = cycle.inside;
  }
  for (MapCycle& cycle : map.cycles) {
    if (cycle.area <= 0) continue;
    const bool outside = std::any_of(cycle.half_edges.begin(), cycle.half_edges.end(), [&](int h) {
      return map.cycles[Index(map.cycle[Index(PlanarMap::Twin(h))])].area <= 0;
    });
    cycle.inside = enclosing[Index(component[Index(map.Origin(cycle.half_edges.front()))])];
    cycle.kind = !outside       ? CycleKind::kOther
                 : cycle.inside ? CycleKind::kIsland
                                : CycleKind::kBorder;
    if (cycle.kind != CycleKind::kIsland) cycle.inside.reset();
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

#include "sketch/map/contacts.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "base/union_find.h"
#include "sketch/map/polyline.h"
#include "sketch/map/segment_grid.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Farthest that a corner is from the line that it touches: as far as ends ever snap.
constexpr double kContact = 0.015;
/// What is enclosed by less than this share of the squared diagonal touches nothing on purpose.
constexpr double kLeastArea = 5e-4;

/// Which pieces of the drawing hang together.
class Pieces {
 public:
  explicit Pieces(const PlanarMap& map) : map_(map), sets_(map.nodes.size()) {
    for (const MapEdge& edge : map.edges)
      sets_.Join(static_cast<std::uint32_t>(edge.nodes[0]),
                 static_cast<std::uint32_t>(edge.nodes[1]));
    area_.resize(map.nodes.size(), 0);
    for (const MapCycle& cycle : map.cycles) {
      if (cycle.kind != CycleKind::kBorder || cycle.half_edges.empty()) continue;
      double& area = area_[static_cast<std::size_t>(OfEdge(cycle.half_edges.front() / 2))];
      area = std::max(area, cycle.area);
    }
  }

  int OfEdge(int edge) { return Root(map_.edges[static_cast<std::size_t>(edge)].nodes[0]); }

  bool IsClosed(int piece) const {
    return area_[static_cast<std::size_t>(piece)] >= kLeastArea * map_.diagonal * map_.diagonal;
  }

  /// True when some piece is closed and is not all that there is.
  bool AreSeveral() {
    int closed = 0, pieces = 0;
    for (int n = 0; n < static_cast<int>(map_.nodes.size()); ++n) {
      if (Root(n) != n) continue;
      ++pieces;
      if (IsClosed(n)) ++closed;
    }
    return closed > 0 && pieces > 1;
  }

  int Root(int node) { return static_cast<int>(sets_.Root(static_cast<std::uint32_t>(node))); }

 private:
  const PlanarMap& map_;
  UnionFind sets_;
  std::vector<double> area_;  ///< the largest that a piece encloses, by root
};

bool IsOutside(const PlanarMap& map, int half_edge) {
  const int cycle = map.cycle[static_cast<std::size_t>(half_edge)];
  return map.cycles[static_cast<std::size_t>(cycle)].kind == CycleKind::kOuter;
}

/// The lines that the outside is beside.
SegmentGrid OuterLines(const PlanarMap& map) {
  std::vector<SegmentRef> segments;
  for (int e = 0; e < static_cast<int>(map.edges.size()); ++e) {
    if (!IsOutside(map, 2 * e) && !IsOutside(map, 2 * e + 1)) continue;
    const Polyline& points = map.edges[static_cast<std::size_t>(e)].points;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      segments.push_back({e, static_cast<int>(k), points[k], points[k + 1]});
  }
  return SegmentGrid(std::move(segments));
}

}  // namespace

std::vector<Closure> FindContacts(const PlanarMap& map) {
  std::vector<Closure> contacts;
  Pieces pieces(map);
  if (!pieces.AreSeveral()) return contacts;
  const SegmentGrid grid = OuterLines(map);
  const double reach = kContact * map.diagonal;
  for (int n = 0; n < static_cast<int>(map.nodes.size()); ++n) {
    const MapNode& node = map.nodes[static_cast<std::size_t>(n)];
    const bool is_outer = std::any_of(node.outgoing.begin(), node.outgoing.end(), [&](int h) {
      return IsOutside(map, h) || IsOutside(map, PlanarMap::Twin(h));
    });
    if (node.outgoing.size() < 2 || !is_outer) continue;
    const int own = pieces.Root(n);
    std::optional<Closure> nearest;
    const Vector2d r = Vector2d::Constant(reach);
    grid.ForEachIn({Vector2d(node.position - r), Vector2d(node.position + r)}, [&](int s) {
      const SegmentRef& line = grid.segments()[static_cast<std::size_t>(s)];
      const int other = pieces.OfEdge(line.line);
      if (other == own || (!pieces.IsClosed(own) && !pieces.IsClosed(other))) return;
      const Vector2d place =
          line.a + NearestParameter(line.a, line.b, node.position) * (line.b - line.a);
      const double distance = (place - node.position).norm();
      if (distance > reach || !(distance > 0) || (nearest && distance >= nearest->Length())) return;
      const Vector2d way = (place - node.position) / distance;
      nearest =
          Closure{node.position, place, node.outgoing.front(), way, Vector2d::Zero(), 0.0, 0.0};
    });
    if (nearest) contacts.push_back(*nearest);
  }
  return contacts;
}

}  // namespace lascaux

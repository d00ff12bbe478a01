#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "sketch/map/arrangement.h"
#include "sketch/map/line_ends.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Points nearer to each other than this share of the diagonal are one node: far below what a hand
/// or a file's third decimal can tell apart, far above rounding.
constexpr double kNodeTolerance = 2e-6;

/// What a line leaves over after it crossed another is a slip of the pen up to this share of the
/// diagonal: the shortest suggestive curves are a little longer.
constexpr double kOvershoot = 0.012;

/// A place on a line where it is cut: position = index of the segment + fraction along it.
struct Cut {
  double position = 0;
  Vector2d point;
};

/// Nodes by place: a point within the tolerance of a node is that node.
class NodeTable {
 public:
  explicit NodeTable(double tolerance) : tolerance_(tolerance) {}

  int At(const Vector2d& p, std::vector<MapNode>& nodes) {
    const Vector2d reach = Vector2d::Constant(tolerance_);
    const CellIndex low = CellOf(p - reach), high = CellOf(p + reach);
    for (std::int64_t y = low.y; y <= high.y; ++y) {
      for (std::int64_t x = low.x; x <= high.x; ++x) {
        const auto found = cells_.find({x, y});
        if (found == cells_.end()) continue;
        for (const int node : found->second) {
          if ((nodes[static_cast<std::size_t>(node)].position - p).norm() <= tolerance_)
            return node;
        }
      }
    }
    nodes.push_back({p, {}});
    cells_[CellOf(p)].push_back(static_cast<int>(nodes.size()) - 1);
    return static_cast<int>(nodes.size()) - 1;
  }

 private:
  struct CellIndex {
    std::int64_t x, y;
    bool operator==(const CellIndex&) const = default;
  };
  struct Hash {
    std::size_t operator()(const CellIndex& cell) const {
      // Two odd constants of many bits spread the neighbours over the table.
      return static_cast<std::size_t>(cell.x) * 0x9E3779B97F4A7C15u ^
             static_cast<std::size_t>(cell.y) * 0xC2B2AE3D27D4EB4Fu;
    }
  };

  CellIndex CellOf(const Vector2d& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / (2 * tolerance_))),
            static_cast<std::int64_t>(std::floor(p.y() / (2 * tolerance_)))};
  }

  double tolerance_;
  std::unordered_map<CellIndex, std::vector<int>, Hash> cells_;
};

/// Consecutive segments of one line always touch; that is no crossing.
bool AreNeighbours(const SegmentRef& s, const SegmentRef& t, const ArrangementLine& line) {
  if (s.line != t.line) return false;
  if (std::abs(s.index - t.index) <= 1) return true;
  const int last = static_cast<int>(line.points.size()) - 2;
  return line.points.front() == line.points.back() && std::min(s.index, t.index) == 0 &&
         std::max(s.index, t.index) == last;
}

/// Ends that lie on another line, and crossings of all pairs of lines, as cuts; none if there are
/// too many.
std::optional<std::vector<std::vector<Cut>>> FindCuts(const std::vector<ArrangementLine>& lines,
                                                      double tolerance) {
  const SegmentGrid grid = GridOf(lines);
  const auto& segments = grid.segments();
  std::vector<std::vector<Cut>> cuts(lines.size());
  int crossings = 0;
  const auto cut = [&](const SegmentRef& s, double t) {
    cuts[static_cast<std::size_t>(s.line)].push_back({s.index + t, s.a + t * (s.b - s.a)});
  };
  for (std::size_t i = 0; i < segments.size() && crossings <= kMaxCrossings; ++i) {
    const SegmentRef& s = segments[i];
    Eigen::AlignedBox2d box(s.a);
    box.extend(s.b);
    grid.ForEachIn(box, [&](int j) {
      if (static_cast<std::size_t>(j) <= i) return;
      const SegmentRef& t = segments[static_cast<std::size_t>(j)];
      if (AreNeighbours(s, t, lines[static_cast<std::size_t>(s.line)])) return;
      const auto hit = Intersection(s.a, s.b, t.a, t.b);
      if (!hit) return;
      ++crossings;
      cut(s, hit->first);
      cut(t, hit->second);
    });
  }
  if (crossings > kMaxCrossings) return std::nullopt;
  for (const ArrangementLine& line : lines) {
    if (line.closed) continue;
    for (const Vector2d& end : {line.points.front(), line.points.back()}) {
      const Vector2d r = Vector2d::Constant(tolerance);
      grid.ForEachIn({Vector2d(end - r), Vector2d(end + r)}, [&](int j) {
        const SegmentRef& t = segments[static_cast<std::size_t>(j)];
        const double u = NearestParameter(t.a, t.b, end);
        if ((t.a + u * (t.b - t.a) - end).norm() <= tolerance) {
          cuts[static_cast<std::size_t>(t.line)].push_back({t.index + u, end});
        }
      });
    }
  }
  return cuts;
}

/// The points of a line between two cuts, the nodes' own positions at both ends.
Polyline PointsBetween(const Polyline& line, const Cut& from, const Cut& to, double tolerance) {
  Polyline points{from.point};
  for (int k = static_cast<int>(std::floor(from.position)) + 1; k < to.position; ++k) {
    const Vector2d& p = line[static_cast<std::size_t>(k)];
    if ((p - points.back()).norm() > tolerance && (p - to.point).norm() > tolerance)
      points.push_back(p);
  }
  points.push_back(to.point);
  return points;
}

/// The same edge drawn twice: same nodes, middles at one place.
bool IsTwin(const MapEdge& a, const MapEdge& b, double tolerance) {
  const bool same = a.nodes == b.nodes,
             swapped = a.nodes[0] == b.nodes[1] && a.nodes[1] == b.nodes[0];
  if (!same && !swapped) return false;
  const double length_a = Length(a.points), length_b = Length(b.points);
  if (std::abs(length_a - length_b) > tolerance) return false;
  for (const double share : {0.25, 0.5, 0.75}) {
    const Vector2d p = PointAtLength(a.points, share * length_a);
    const Vector2d q = PointAtLength(b.points, (same ? share : 1 - share) * length_b);
    if ((p - q).norm() > tolerance) return false;
  }
  return true;
}

/// Adds the pieces of one line to the map.
void AddEdges(PlanarMap& map, NodeTable& table, const ArrangementLine& line,
              std::vector<Cut> cuts) {
  const double tolerance = kNodeTolerance * map.diagonal;
  const double last = static_cast<double>(line.points.size()) - 1;
  cuts.push_back({0, line.points.front()});
  cuts.push_back({last, line.points.back()});
  std::stable_sort(cuts.begin(), cuts.end(),
                   [](const Cut& a, const Cut& b) { return a.position < b.position; });
  int node = table.At(cuts.front().point, map.nodes);
  cuts.front().point = map.nodes[static_cast<std::size_t>(node)].position;
  std::size_t from = 0;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const int next = table.At(cuts[k].point, map.nodes);
    cuts[k].point = map.nodes[static_cast<std::size_t>(next)].position;
    MapEdge edge{PointsBetween(line.points, cuts[from], cuts[k], tolerance),
                 {},
                 {},
                 line.stroke,
                 {node, next}};
    // Two cuts at one place are one cut, unless the line ran a loop in between.
    if (next == node && (edge.points.size() < 4 || Length(edge.points) < 4 * tolerance)) continue;
    map.edges.push_back(std::move(edge));
    node = next;
    from = k;
  }
}

void DropTwins(PlanarMap& map) {
  const double tolerance = 1e-3 * map.diagonal;
  std::map<std::pair<int, int>, std::vector<std::size_t>> by_nodes;
  std::vector<MapEdge> kept;
  for (MapEdge& edge : map.edges) {
    auto& same = by_nodes[std::minmax(edge.nodes[0], edge.nodes[1])];
    const bool twin = std::any_of(same.begin(), same.end(),
                                  [&](std::size_t k) { return IsTwin(kept[k], edge, tolerance); });
    if (twin) continue;
    same.push_back(kept.size());
    kept.push_back(std::move(edge));
  }
  map.edges = std::move(kept);
}

/// True when both an edge's stroke and another one run through a node.
bool IsCrossing(const PlanarMap& map, const std::vector<int>& edges, int stroke) {
  int own = 0, other = 0;
  for (const int e : edges)
    ++(map.edges[static_cast<std::size_t>(e)].stroke == stroke ? own : other);
  return own == 2 && other >= 2;
}

/// Removes dangling edges shorter than the snap radius of their lines, and those that a line has
/// left over after it crossed another, if they are not much longer; again and again: behind a spur
/// there may be another.
void DropSpurs(PlanarMap& map, const std::vector<ArrangementLine>& lines) {
  std::unordered_map<int, double> shortest;
  for (const ArrangementLine& line : lines) {
    auto& value = shortest[line.stroke];
    value = std::max(value, line.snap);
  }
  for (bool again = true; again;) {
    again = false;
    std::vector<std::vector<int>> at(map.nodes.size());
    for (int e = 0; e < static_cast<int>(map.edges.size()); ++e) {
      for (const int node : map.edges[static_cast<std::size_t>(e)].nodes)
        at[static_cast<std::size_t>(node)].push_back(e);
    }
    const auto is_spur = [&](const MapEdge& edge) {
      const auto &a = at[static_cast<std::size_t>(edge.nodes[0])],
                 &b = at[static_cast<std::size_t>(edge.nodes[1])];
      const auto& root = a.size() == 1 ? b : a;
      if (std::min(a.size(), b.size()) != 1 || root.size() <= 2) return false;
      const double length = Length(edge.points);
      return length < shortest[edge.stroke] ||
             (length < kOvershoot * map.diagonal && shortest[edge.stroke] > 0 &&
              IsCrossing(map, root, edge.stroke));
    };
    std::vector<bool> drop;
    for (const MapEdge& edge : map.edges) drop.push_back(is_spur(edge));
    std::size_t kept = 0;
    for (std::size_t e = 0; e < map.edges.size(); ++e) {
      if (!drop[e] && kept++ != e) map.edges[kept - 1] = std::move(map.edges[e]);
    }
    again = kept != map.edges.size();
    map.edges.resize(kept);
  }
}

}  // namespace

Outcome<PlanarMap> Arrange(const std::vector<ArrangementLine>& lines, double diagonal) {
  PlanarMap map;
  map.diagonal = diagonal;
  auto cuts = FindCuts(lines, kNodeTolerance * diagonal);
  if (!cuts) {
    return Outcome<PlanarMap>::Failure(
        Error(FailureKind::kUnderstanding, "too-tangled",
              "the strokes cross each other more than " + std::to_string(kMaxCrossings) +
                  " times; draw outlines and the lines where limbs merge, without hatching"));
  }
  NodeTable table(kNodeTolerance * diagonal);
  // Ends first: where nodes compete for a place, an end's own position is the one that was drawn.
  for (const ArrangementLine& line : lines) {
    table.At(line.points.front(), map.nodes);
    table.At(line.points.back(), map.nodes);
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    AddEdges(map, table, lines[i], std::move((*cuts)[i]));
  DropTwins(map);
  DropSpurs(map, lines);
  return WithoutEdges(map, std::vector<bool>(map.edges.size(), false));
}

}  // namespace lascaux

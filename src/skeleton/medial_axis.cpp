#include "skeleton/medial_axis.h"

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "skeleton/index.h"
#include "skeleton/inside_test.h"

namespace lascaux {
namespace {

using Diagram = boost::polygon::voronoi_diagram<double>;
using Eigen::Vector2d;

/// Boost's sweep takes 32-bit integers; this leaves room for its sums.
constexpr double kIntegerExtent = 1 << 28;
/// An outline piece may be this long relative to the discs that touch its ends.
constexpr double kFineness = 0.5;
/// A piece is never cut below this share of the longest one: it bounds the work in sharp corners.
constexpr double kFinestPiece = 1.0 / 32;
constexpr int kMostCuts = 4;
constexpr int kMaxRefinements = 6;
/// Discs whose centres are this near, relative to the outline's mean piece, are one: cocircular
/// samples give a cluster.
constexpr double kWeld = 0.02;

class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(Index(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Find(int i) {
    while (parent_[Index(i)] != i) i = parent_[Index(i)] = parent_[Index(parent_[Index(i)])];
    return i;
  }
  bool Unite(int a, int b) {
    a = Find(a), b = Find(b);
    if (a == b) return false;
    parent_[Index(std::max(a, b))] = std::min(a, b);
    return true;
  }

 private:
  std::vector<int> parent_;
};

/// Voronoi vertices as discs, with the edges that no outline piece is dual to.
struct Graph {
  std::vector<SkeletonVertex> discs;
  std::vector<std::array<int, 2>> edges;
  std::vector<char> touches_infinity;
  std::vector<char> piece_present;          ///< ring piece i has a Voronoi edge between its ends
  std::vector<std::array<int, 2>> touches;  ///< a disc and a sample on its circle
};

struct Grid {
  Vector2d center;
  double scale;  ///< integers a unit

  explicit Grid(const Ring& ring) {
    Vector2d low = ring[0], high = ring[0];
    for (const Vector2d& p : ring) low = low.cwiseMin(p), high = high.cwiseMax(p);
    center = (low + high) / 2;
    scale = kIntegerExtent / std::max((high - low).maxCoeff(), 1e-300);
  }
};

/// Distance from a point to the two pieces of the ring that meet at sample i.
double DistanceAround(const Ring& ring, std::size_t i, const Vector2d& point) {
  const std::size_t n = ring.size();
  return std::min(DistanceToSegment(point, ring[(i + n - 1) % n], ring[i]),
                  DistanceToSegment(point, ring[i], ring[(i + 1) % n]));
}

Graph DualGraph(const Ring& ring) {
  const Grid grid(ring);
  std::vector<boost::polygon::point_data<int>> sites;
  sites.reserve(ring.size());
  for (const Vector2d& p : ring) {
    const Vector2d q = (p - grid.center) * grid.scale;
    sites.emplace_back(static_cast<int>(std::lround(q.x())), static_cast<int>(std::lround(q.y())));
  }
  Diagram diagram;
  boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);

  Graph graph;
  const std::size_t n = ring.size(), m = diagram.vertices().size();
  graph.discs.resize(m);
  graph.touches_infinity.assign(m, 0);
  graph.piece_present.assign(n, 0);
  for (std::size_t v = 0; v < m; ++v) {
    const auto& vertex = diagram.vertices()[v];
    SkeletonVertex& disc = graph.discs[v];
    disc.position = grid.center + Vector2d(vertex.x(), vertex.y()) / grid.scale;
    disc.radius = std::numeric_limits<double>::infinity();
    const auto* edge = vertex.incident_edge();
    do {
      const std::size_t site = edge->cell()->source_index();
      disc.radius = std::min(disc.radius, DistanceAround(ring, site, disc.position));
      graph.touches.push_back({static_cast<int>(v), static_cast<int>(site)});
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
  }
  const auto index_of = [&](const Diagram::vertex_type* vertex) {
    return static_cast<int>(vertex - diagram.vertices().data());
  };
  for (const auto& edge : diagram.edges()) {
    if (&edge > edge.twin()) continue;
    const std::size_t a = edge.cell()->source_index(), b = edge.twin()->cell()->source_index();
    if ((a + 1) % n == b || (b + 1) % n == a) {
      graph.piece_present[(a + 1) % n == b ? a : b] = 1;
    } else if (edge.is_finite()) {
      graph.edges.push_back({index_of(edge.vertex0()), index_of(edge.vertex1())});
    } else {
      const auto* end = edge.vertex0() != nullptr ? edge.vertex0() : edge.vertex1();
      if (end != nullptr) graph.touches_infinity[Index(index_of(end))] = 1;
    }
  }
  return graph;
}

bool IsSeparated(const Graph& graph) {
  return std::all_of(graph.piece_present.begin(), graph.piece_present.end(),
                     [](char present) { return present != 0; });
}

/// Which vertices lie inside. Where every outline piece cuts the graph, what reaches infinity is
/// outside: no geometry is asked, so nothing can be rounded wrong.
std::vector<char> InsideMask(const Graph& graph, const Ring& ring) {
  const int m = static_cast<int>(graph.discs.size());
  std::vector<char> inside(Index(m), 1);
  if (!IsSeparated(graph)) {
    const InsideTest test(ring);
    for (int v = 0; v < m; ++v)
      inside[Index(v)] = test.Contains(graph.discs[Index(v)].position) ? 1 : 0;
    return inside;
  }
  DisjointSets sets(m);
  for (const auto& [a, b] : graph.edges) sets.Unite(a, b);
  std::vector<char> outside_root(Index(m), 0);
  for (int v = 0; v < m; ++v) {
    if (graph.touches_infinity[Index(v)]) outside_root[Index(sets.Find(v))] = 1;
  }
  for (int v = 0; v < m; ++v) inside[Index(v)] = outside_root[Index(sets.Find(v))] ? 0 : 1;
  return inside;
}

/// Into how many pieces each piece of the ring is to be cut because it is long against the discs
/// inside that touch its ends.
std::vector<int> CutsForWidth(const Ring& ring, const Graph& graph,
                              const std::vector<char>& inside) {
  const std::size_t n = ring.size();
  std::vector<double> reach(n, 0);
  for (const auto& [disc, site] : graph.touches) {
    if (inside[Index(disc)])
      reach[Index(site)] = std::max(reach[Index(site)], graph.discs[Index(disc)].radius);
  }
  std::vector<int> cuts(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const double length = (ring[next] - ring[i]).norm();
    const double wanted = kFineness * std::min(reach[i], reach[next]);
    cuts[i] = length > kMostCuts * wanted
                  ? kMostCuts
                  : std::max(1, static_cast<int>(std::ceil(length / wanted)));
  }
  return cuts;
}

/// In two, where the diagram does not separate the sides of a piece that is longer than `finest`.
std::vector<int> CutsForSeparation(const Ring& ring, const Graph& graph, double finest) {
  const std::size_t n = ring.size();
  std::vector<int> cuts(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double length = (ring[(i + 1) % n] - ring[i]).norm();
    if (length > finest && !graph.piece_present[i]) cuts[i] = 2;
  }
  return cuts;
}

Ring Cut(const Ring& ring, const std::vector<int>& cuts) {
  Ring refined;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d step = (ring[(i + 1) % ring.size()] - ring[i]) / cuts[i];
    for (int k = 0; k < cuts[i]; ++k) refined.push_back(ring[i] + k * step);
  }
  return refined;
}

/// Edges of a spanning forest of the inside, widest passages first.
std::vector<std::array<int, 2>> SpanningForest(const Graph& graph,
                                               const std::vector<char>& inside) {
  std::vector<std::pair<double, int>> order;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const auto& [a, b] = graph.edges[e];
    if (!inside[Index(a)] || !inside[Index(b)]) continue;
    order.emplace_back(-std::min(graph.discs[Index(a)].radius, graph.discs[Index(b)].radius),
                       static_cast<int>(e));
  }
  std::sort(order.begin(), order.end());
  DisjointSets sets(static_cast<int>(graph.discs.size()));
  std::vector<std::array<int, 2>> forest;
  for (const auto& [width, e] : order) {
    if (sets.Unite(graph.edges[Index(e)][0], graph.edges[Index(e)][1]))
      forest.push_back(graph.edges[Index(e)]);
  }
  return forest;
}

/// The tree of the forest that holds `root`, with vertices in breadth-first order; discs nearer
/// than `weld` to the disc that they descend from are merged into it.
Skeleton TreeFrom(const Graph& graph, const std::vector<std::array<int, 2>>& forest, int root,
                  double weld) {
  std::vector<std::vector<int>> neighbours(graph.discs.size());
  for (const auto& [a, b] : forest)
    neighbours[Index(a)].push_back(b), neighbours[Index(b)].push_back(a);
  Skeleton tree;
  std::vector<int> image(graph.discs.size(), -1);
  std::vector<int> queue{root};
  tree.vertices.push_back(graph.discs[Index(root)]);
  image[Index(root)] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const int v = queue[head];
    for (const int w : neighbours[Index(v)]) {
      if (image[Index(w)] >= 0) continue;
      queue.push_back(w);
      if ((graph.discs[Index(w)].position - tree.vertices[Index(image[Index(v)])].position).norm() <
          weld) {
        image[Index(w)] = image[Index(v)];
        continue;
      }
      image[Index(w)] = static_cast<int>(tree.vertices.size());
      tree.vertices.push_back(graph.discs[Index(w)]);
      tree.edges.push_back({image[Index(v)], image[Index(w)]});
    }
  }
  return tree;
}

}  // namespace

Skeleton MedialAxis(const Ring& outline) {
  if (outline.size() < 3) return {};
  Ring ring = outline;
  double longest = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    longest = std::max(longest, (ring[(i + 1) % ring.size()] - ring[i]).norm());
  }
  Graph graph = DualGraph(ring);
  std::vector<char> inside = InsideMask(graph, ring);
  for (int round = 0; round < kMaxRefinements; ++round) {
    Ring refined = Cut(ring, round == 0 ? CutsForWidth(ring, graph, inside)
                                        : CutsForSeparation(ring, graph, longest * kFinestPiece));
    if (refined.size() == ring.size() && (round > 0 || IsSeparated(graph))) break;
    ring = std::move(refined);
    graph = DualGraph(ring);
    inside = InsideMask(graph, ring);
  }
  int root = -1;
  for (int v = 0; v < static_cast<int>(graph.discs.size()); ++v) {
    if (inside[Index(v)] &&
        (root < 0 || graph.discs[Index(v)].radius > graph.discs[Index(root)].radius))
      root = v;
  }
  if (root < 0) return {};
  const double piece = Perimeter(ring) / static_cast<double>(ring.size());
  return TreeFrom(graph, SpanningForest(graph, inside), root, kWeld * piece);
}

}  // namespace lascaux

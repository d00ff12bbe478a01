#pragma once

#include <cstdint>
#include <vector>

/// @file
/// The cheapest cut of a graph, for choices that hang together.

namespace lascaux {

/// A graph whose links cost something to cut.
class CutGraph {
 public:
  explicit CutGraph(int nodes) : links_(static_cast<std::size_t>(nodes)) {}

  /// A link that costs `there` to cut when `a` is on the source's side, `back` when `b` is.
  void Link(int a, int b, std::int64_t there, std::int64_t back);

  /// Which nodes stay on the source's side of a cut of least cost; of several the smallest set.
  ///
  /// By maximum flow (Dinic 1970): O(nodes^2 links) at worst, near linear in graphs of faces.
  /// Uses up the graph.
  std::vector<bool> SourceSide(int source, int sink);

 private:
  struct Arc {
    int to = 0;
    std::int64_t left = 0;     ///< capacity that is left
    std::size_t opposite = 0;  ///< its index among the arcs
  };

  /// Distances from the source along arcs with capacity left; -1 where there is no way.
  std::vector<int> Levels(int source) const;
  /// Sends flow along one shortest path; what was sent, 0 when there is none.
  std::int64_t Augment(int source, int sink, const std::vector<int>& levels,
                       std::vector<std::size_t>& next);

  std::vector<Arc> arcs_;
  std::vector<std::vector<std::size_t>> links_;  ///< indices into arcs_, by node
};

}  // namespace lascaux

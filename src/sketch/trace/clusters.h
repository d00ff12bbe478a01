#pragma once

#include <vector>

#include "sketch/trace/ink_graph.h"

namespace lascaux::trace {

/// Nodes of a graph that are one junction.
struct Clusters {
  std::vector<int> of_node;             ///< cluster of each node
  std::vector<std::vector<int>> nodes;  ///< nodes of each cluster
  std::vector<bool> inside;             ///< of each branch: it is a part of its cluster
};

/// Joins junctions that a branch shorter than `widths` of the ink connects, unless it is on a cycle
/// of such branches: that one encloses a region. Linear but for the union-find.
Clusters ClustersOf(const InkGraph& graph, double widths);

}  // namespace lascaux::trace

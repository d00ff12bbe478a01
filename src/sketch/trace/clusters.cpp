#include "sketch/trace/clusters.h"

#include <algorithm>
#include <numeric>

namespace lascaux::trace {
namespace {

int Root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    int& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

/// The branches that are short enough to be no branches of the drawing.
std::vector<int> ShortBranches(const InkGraph& graph, double widths) {
  std::vector<int> result;
  for (std::size_t i = 0; i < graph.branches.size(); ++i) {
    const Branch& branch = graph.branches[i];
    if (branch.removed || branch.nodes[0] < 0) continue;
    const InkNode& a = graph.nodes[static_cast<std::size_t>(branch.nodes[0])];
    const InkNode& b = graph.nodes[static_cast<std::size_t>(branch.nodes[1])];
    if (a.ends.size() < 3 || b.ends.size() < 3) continue;
    if (LengthOf(branch.points) < widths * (a.half_width + b.half_width))
      result.push_back(static_cast<int>(i));
  }
  return result;
}

/// The short branches that are on no cycle of short branches: a forest of them is walked breadth
/// first, and what each other branch closes is marked upward from both of its ends.
class Bridges {
 public:
  Bridges(const InkGraph& graph, const std::vector<int>& candidates)
      : graph_(graph),
        neighbours_(graph.nodes.size()),
        up_(graph.nodes.size(), -1),
        depth_(graph.nodes.size(), -1),
        merged_(graph.nodes.size()),
        is_bridge_(graph.branches.size()) {
    std::iota(merged_.begin(), merged_.end(), 0);
    for (const int id : candidates)
      for (const int node : Of(id).nodes) neighbours_[static_cast<std::size_t>(node)].push_back(id);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
      if (depth_[i] < 0) Grow(static_cast<int>(i));
    for (const int id : candidates)
      if (!is_bridge_[static_cast<std::size_t>(id)]) MarkCycle(Of(id).nodes[0], Of(id).nodes[1]);
  }

  std::vector<bool> Take() && { return std::move(is_bridge_); }

 private:
  const Branch& Of(int id) const { return graph_.branches[static_cast<std::size_t>(id)]; }
  int Other(int id, int node) const {
    return Of(id).nodes[0] == node ? Of(id).nodes[1] : Of(id).nodes[0];
  }

  void Grow(int root) {
    depth_[static_cast<std::size_t>(root)] = 0;
    std::vector<int> queue{root};
    for (std::size_t n = 0; n < queue.size(); ++n) {
      const int here = queue[n];
      for (const int id : neighbours_[static_cast<std::size_t>(here)]) {
        const auto there = static_cast<std::size_t>(Other(id, here));
        if (depth_[there] >= 0) continue;
        depth_[there] = depth_[static_cast<std::size_t>(here)] + 1;
        up_[there] = id;
        is_bridge_[static_cast<std::size_t>(id)] = true;
        queue.push_back(static_cast<int>(there));
      }
    }
  }

  void MarkCycle(int a, int b) {
    a = Root(merged_, a);
    b = Root(merged_, b);
    while (a != b) {
      int& deeper =
          depth_[static_cast<std::size_t>(a)] >= depth_[static_cast<std::size_t>(b)] ? a : b;
      const int id = up_[static_cast<std::size_t>(deeper)];
      is_bridge_[static_cast<std::size_t>(id)] = false;
      const int parent = Other(id, deeper);
      merged_[static_cast<std::size_t>(deeper)] = parent;
      deeper = Root(merged_, parent);
    }
  }

  const InkGraph& graph_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<int> up_, depth_, merged_;
  std::vector<bool> is_bridge_;
};

}  // namespace

Clusters ClustersOf(const InkGraph& graph, double widths) {
  Clusters clusters;
  clusters.inside = Bridges(graph, ShortBranches(graph, widths)).Take();
  std::vector<int> parent(graph.nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < graph.branches.size(); ++i)
    if (clusters.inside[i]) {
      const auto& nodes = graph.branches[i].nodes;
      parent[static_cast<std::size_t>(Root(parent, nodes[0]))] = Root(parent, nodes[1]);
    }
  clusters.of_node.assign(graph.nodes.size(), -1);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto root = static_cast<std::size_t>(Root(parent, static_cast<int>(i)));
    if (clusters.of_node[root] < 0) {
      clusters.of_node[root] = static_cast<int>(clusters.nodes.size());
      clusters.nodes.emplace_back();
    }
    clusters.of_node[i] = clusters.of_node[root];
    clusters.nodes[static_cast<std::size_t>(clusters.of_node[i])].push_back(static_cast<int>(i));
  }
  return clusters;
}

}  // namespace lascaux::trace

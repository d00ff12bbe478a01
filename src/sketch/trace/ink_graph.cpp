#include "sketch/trace/ink_graph.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "sketch/trace/distance.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;
using std::int32_t;

/// Walks the skeleton's pixels. A pixel with two neighbours is inside of a branch, every other one
/// is a node or a part of one.
class Walker {
 public:
  Walker(const Mask& skeleton, const Plane<int32_t>& squared)
      : ink_(skeleton),
        squared_(squared),
        node_(skeleton.width, skeleton.height, -1),
        visited_(skeleton.width, skeleton.height) {}

  InkGraph Run() && {
    for (std::size_t i = 0; i < ink_.data.size(); ++i)
      if (ink_.data[i]) pixels_.push_back(static_cast<int32_t>(i));
    for (const int32_t i : pixels_)
      if (NeighboursOf(i).size() != 2 && node_.data[At(i)] < 0) AddNode(i);
    for (const int32_t i : pixels_)
      if (node_.data[At(i)] >= 0)
        for (const int32_t j : NeighboursOf(i))
          if (node_.data[At(j)] < 0 && !visited_.data[At(j)]) Walk(i, j);
    for (const int32_t i : pixels_)
      if (node_.data[At(i)] < 0 && !visited_.data[At(i)]) WalkRound(i);
    return std::move(graph_);
  }

 private:
  static std::size_t At(int32_t i) { return static_cast<std::size_t>(i); }
  Vector2d PointOf(int32_t i) const { return {i % ink_.width + 0.5, i / ink_.width + 0.5}; }
  double HalfWidthAt(int32_t i) const { return HalfWidth(squared_.data[At(i)]); }

  std::vector<int32_t> NeighboursOf(int32_t i) const {
    std::vector<int32_t> result;
    for (int k = 0; k < 8; ++k) {
      const int32_t j = i + kDy[k] * ink_.width + kDx[k];
      if (ink_.data[At(j)]) result.push_back(j);
    }
    return result;
  }

  /// All adjacent pixels that are inside of no branch are one node, at their middle.
  void AddNode(int32_t first) {
    const int id = static_cast<int>(graph_.nodes.size());
    InkNode node{Vector2d::Zero(), 0, {}};
    std::vector<int32_t> cluster{first};
    node_.data[At(first)] = id;
    for (std::size_t n = 0; n < cluster.size(); ++n) {
      node.at += PointOf(cluster[n]);
      node.half_width = std::max(node.half_width, HalfWidthAt(cluster[n]));
      for (const int32_t j : NeighboursOf(cluster[n])) {
        if (node_.data[At(j)] >= 0 || NeighboursOf(j).size() == 2) continue;
        node_.data[At(j)] = id;
        cluster.push_back(j);
      }
    }
    node.at /= static_cast<double>(cluster.size());
    graph_.nodes.push_back(std::move(node));
  }

  void Append(Branch& branch, int32_t i) {
    visited_.data[At(i)] = 1;
    branch.points.push_back(PointOf(i));
    branch.half_widths.push_back(HalfWidthAt(i));
  }

  void Walk(int32_t from, int32_t first) {
    Branch branch;
    const auto add_node = [&](int end, int id) {
      branch.nodes[static_cast<std::size_t>(end)] = id;
      branch.points.push_back(graph_.nodes[static_cast<std::size_t>(id)].at);
      branch.half_widths.push_back(graph_.nodes[static_cast<std::size_t>(id)].half_width);
    };
    add_node(0, node_.data[At(from)]);
    int32_t before = from, here = first;
    while (node_.data[At(here)] < 0) {
      Append(branch, here);
      const std::vector<int32_t> next = NeighboursOf(here);
      const int32_t onward = next[0] == before ? next[1] : next[0];
      before = here;
      here = onward;
    }
    add_node(1, node_.data[At(here)]);
    const int id = static_cast<int>(graph_.branches.size());
    for (int end = 0; end < 2; ++end)
      graph_.nodes[static_cast<std::size_t>(branch.nodes[static_cast<std::size_t>(end)])]
          .ends.push_back({id, end});
    graph_.branches.push_back(std::move(branch));
  }

  void WalkRound(int32_t first) {
    Branch branch;
    int32_t before = -1, here = first;
    do {
      Append(branch, here);
      const std::vector<int32_t> next = NeighboursOf(here);
      const int32_t onward = next[0] == before ? next[1] : next[0];
      before = here;
      here = onward;
    } while (here != first);
    branch.points.push_back(branch.points.front());
    branch.half_widths.push_back(branch.half_widths.front());
    graph_.branches.push_back(std::move(branch));
  }

  const Mask& ink_;
  const Plane<int32_t>& squared_;
  Plane<int32_t> node_;
  Mask visited_;
  std::vector<int32_t> pixels_;
  InkGraph graph_;
};

void Reverse(Branch& branch) {
  std::reverse(branch.points.begin(), branch.points.end());
  std::reverse(branch.half_widths.begin(), branch.half_widths.end());
  std::swap(branch.nodes[0], branch.nodes[1]);
}

class Pruning {
 public:
  Pruning(InkGraph& graph, double widths) : graph_(graph), widths_(widths) {}

  void Run() {
    // Where pixels only touch in a corner of the line.
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
      if (graph_.nodes[i].ends.size() == 2) Merge(static_cast<int>(i));
    for (std::size_t i = 0; i < graph_.branches.size(); ++i) Consider(static_cast<int>(i));
    while (!queue_.empty()) {
      const auto [length, id] = queue_.top();
      queue_.pop();
      // Merged meanwhile, or its junction is gone.
      if (IsSpur(id) && LengthOf(Of(id).points) == length) Remove(id);
    }
  }

 private:
  Branch& Of(int id) { return graph_.branches[static_cast<std::size_t>(id)]; }
  InkNode& NodeOf(int id) { return graph_.nodes[static_cast<std::size_t>(id)]; }

  /// The end of a branch that is at a junction, if the other one is free.
  int RootOf(const Branch& branch) {
    for (int end = 0; end < 2; ++end) {
      if (branch.nodes[0] < 0) return -1;
      const std::size_t here = NodeOf(branch.nodes[static_cast<std::size_t>(end)]).ends.size();
      const std::size_t there = NodeOf(branch.nodes[static_cast<std::size_t>(1 - end)]).ends.size();
      if (here >= 3 && there == 1) return end;
    }
    return -1;
  }

  bool IsSpur(int id) {
    const Branch& branch = Of(id);
    if (branch.removed) return false;
    const int root = RootOf(branch);
    if (root < 0) return false;
    const InkNode& node = NodeOf(branch.nodes[static_cast<std::size_t>(root)]);
    return LengthOf(branch.points) < widths_ * 2 * node.half_width;
  }

  void Consider(int id) {
    if (IsSpur(id)) queue_.emplace(LengthOf(Of(id).points), id);
  }

  void Detach(int node, BranchEnd end) { std::erase(NodeOf(node).ends, end); }

  void Remove(int id) {
    Branch& spur = Of(id);
    spur.removed = true;
    for (int end = 0; end < 2; ++end) {
      const int node = spur.nodes[static_cast<std::size_t>(end)];
      Detach(node, {id, end});
      if (NodeOf(node).ends.empty()) NodeOf(node).half_width = 0;
    }
    const int root = NodeOf(spur.nodes[0]).ends.empty() ? spur.nodes[1] : spur.nodes[0];
    if (NodeOf(root).ends.size() == 2) Merge(root);
  }

  void Merge(int node) {
    const BranchEnd a = NodeOf(node).ends[0], b = NodeOf(node).ends[1];
    NodeOf(node).ends.clear();
    NodeOf(node).half_width = 0;
    if (a.branch == b.branch) {  // a loop without a beginning
      Of(a.branch).nodes = {-1, -1};
      return;
    }
    Branch& first = Of(a.branch);
    Branch& second = Of(b.branch);
    for (const int id : {a.branch, b.branch})
      for (int end = 0; end < 2; ++end)
        if (const int at = Of(id).nodes[static_cast<std::size_t>(end)]; at != node)
          Detach(at, {id, end});
    if (a.end == 0) Reverse(first);
    if (b.end == 1) Reverse(second);
    first.points.insert(first.points.end(), second.points.begin() + 1, second.points.end());
    first.half_widths.insert(first.half_widths.end(), second.half_widths.begin() + 1,
                             second.half_widths.end());
    first.nodes[1] = second.nodes[1];
    second.removed = true;
    for (int end = 0; end < 2; ++end)
      NodeOf(first.nodes[static_cast<std::size_t>(end)]).ends.push_back({a.branch, end});
    Consider(a.branch);
  }

  InkGraph& graph_;
  double widths_;
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
      queue_;
};

}  // namespace

double LengthOf(const std::vector<Vector2d>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

InkGraph GraphOf(const Mask& skeleton, const Plane<int32_t>& squared_distances) {
  return Walker(skeleton, squared_distances).Run();
}

void RemoveSpurs(InkGraph& graph, double widths) { Pruning(graph, widths).Run(); }

}  // namespace lascaux::trace

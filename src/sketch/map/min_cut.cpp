#include "sketch/map/min_cut.h"

#include <algorithm>
#include <limits>

namespace lascaux {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void CutGraph::Link(int a, int b, std::int64_t there, std::int64_t back) {
  const std::size_t first = arcs_.size();
  arcs_.push_back({b, there, first + 1});
  arcs_.push_back({a, back, first});
  links_[Index(a)].push_back(first);
  links_[Index(b)].push_back(first + 1);
}

std::vector<int> CutGraph::Levels(int source) const {
  std::vector<int> levels(links_.size(), -1), queue{source};
  levels[Index(source)] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::size_t a : links_[Index(queue[i])]) {
      const Arc& arc = arcs_[a];
      if (arc.left <= 0 || levels[Index(arc.to)] >= 0) continue;
      levels[Index(arc.to)] = levels[Index(queue[i])] + 1;
      queue.push_back(arc.to);
    }
  }
  return levels;
}

std::int64_t CutGraph::Augment(int source, int sink, const std::vector<int>& levels,
                               std::vector<std::size_t>& next) {
  std::vector<std::size_t> path;
  for (int node = source; node != sink;) {
    std::size_t& k = next[Index(node)];
    const std::vector<std::size_t>& out = links_[Index(node)];
    while (k < out.size() && !(arcs_[out[k]].left > 0 &&
                               levels[Index(arcs_[out[k]].to)] == levels[Index(node)] + 1)) {
      ++k;
    }
    if (k < out.size()) {
      path.push_back(out[k]);
      node = arcs_[out[k]].to;
      continue;
    }
    if (path.empty()) return 0;
    // A dead end: back one step, and never this way again.
    node = arcs_[arcs_[path.back()].opposite].to;
    path.pop_back();
    ++next[Index(node)];
  }
  std::int64_t flow = std::numeric_limits<std::int64_t>::max();
  for (const std::size_t a : path) flow = std::min(flow, arcs_[a].left);
  for (const std::size_t a : path) {
    arcs_[a].left -= flow;
    arcs_[arcs_[a].opposite].left += flow;
  }
  return flow;
}

std::vector<bool> CutGraph::SourceSide(int source, int sink) {
  while (true) {
    const std::vector<int> levels = Levels(source);
    if (levels[Index(sink)] < 0) {
      std::vector<bool> side(levels.size());
      for (std::size_t i = 0; i < side.size(); ++i) side[i] = levels[i] >= 0;
      return side;
    }
    std::vector<std::size_t> next(links_.size(), 0);
    while (Augment(source, sink, levels, next) > 0) {
    }
  }
}

}  // namespace lascaux

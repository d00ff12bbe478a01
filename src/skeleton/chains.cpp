#include "skeleton/chains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skeleton/index.h"
#include "skeleton/tree.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Of an edge, in mean radii: with fewer vertices the fit has to trade them off against each other,
/// and radii run away.
constexpr double kLongestPiece = 1.0;
constexpr double kThinnestTip = 1e-3;

/// Walks over the edges that no chain has taken yet.
class ChainCutter {
 public:
  explicit ChainCutter(const Skeleton& tree)
      : tree_(tree), neighbours_(Neighbours(tree)), on_chain_(tree.vertices.size(), 0) {}

  std::vector<Chain> Cut() {
    std::vector<Chain> chains;
    const int end = Farthest(0, tree_.vertices[0].radius).back();
    Take(Farthest(end, tree_.vertices[Index(end)].radius), chains);
    while (true) {
      std::vector<int> longest;
      double length = -1;
      for (std::size_t v = 0; v < on_chain_.size(); ++v) {
        if (!on_chain_[v]) continue;
        std::vector<int> path = Farthest(static_cast<int>(v), 0);
        if (path.size() > 1 && length_ > length) length = length_, longest = std::move(path);
      }
      if (longest.empty()) return chains;
      Take(longest, chains);
    }
  }

 private:
  /// The longest path from `start` that meets no other vertex of a chain; its length goes to
  /// length_.
  std::vector<int> Farthest(int start, double offset) {
    struct Visit {
      int vertex, from;
      double length;
    };
    std::vector<Visit> visits{{start, -1, offset}};
    std::size_t best = 0;
    double best_length = -1;
    for (std::size_t head = 0; head < visits.size(); ++head) {
      const Visit visit = visits[head];
      const double reached = visit.length + tree_.vertices[Index(visit.vertex)].radius;
      if (head > 0 && reached > best_length) best_length = reached, best = head;
      const int previous = visit.from < 0 ? -1 : visits[Index(visit.from)].vertex;
      for (const int w : neighbours_[Index(visit.vertex)]) {
        if (w == previous || on_chain_[Index(w)]) continue;
        const double step =
            (tree_.vertices[Index(w)].position - tree_.vertices[Index(visit.vertex)].position)
                .norm();
        visits.push_back({w, static_cast<int>(head), visit.length + step});
      }
    }
    length_ = best_length;
    std::vector<int> path;
    for (int at = static_cast<int>(best); at >= 0; at = visits[Index(at)].from) {
      path.push_back(visits[Index(at)].vertex);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  void Take(const std::vector<int>& path, std::vector<Chain>& chains) {
    Chain chain;
    for (const int v : path) {
      chain.vertices.push_back(tree_.vertices[Index(v)]);
      on_chain_[Index(v)] = 1;
    }
    chains.push_back(std::move(chain));
  }

  const Skeleton& tree_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<char> on_chain_;
  double length_ = 0;
};

}  // namespace

std::vector<Chain> CutIntoChains(const Skeleton& tree) { return ChainCutter(tree).Cut(); }

Chain Refined(const Chain& chain) {
  Chain refined;
  double largest = 0;
  for (const SkeletonVertex& v : chain.vertices) largest = std::max(largest, v.radius);
  for (const SkeletonVertex& next : chain.vertices) {
    if (!refined.vertices.empty()) {
      const SkeletonVertex last = refined.vertices.back();
      const double length = (next.position - last.position).norm();
      const double mean = (next.radius + last.radius) / 2;
      const int pieces = std::max(1, static_cast<int>(std::ceil(length / (kLongestPiece * mean))));
      for (int i = 1; i < pieces; ++i) {
        const double t = static_cast<double>(i) / pieces;
        refined.vertices.push_back({last.position + t * (next.position - last.position),
                                    last.radius + t * (next.radius - last.radius)});
      }
    }
    refined.vertices.push_back(next);
  }
  for (SkeletonVertex& v : refined.vertices) v.radius = std::max(v.radius, kThinnestTip * largest);
  return refined;
}

Vector2d EndDirection(const Chain& chain, std::size_t end) {
  // Ends that coincide still point away from each other, or the two caps would shift the ball.
  const Vector2d none = end == 0 ? Vector2d(-Vector2d::UnitX()) : Vector2d(Vector2d::UnitX());
  if (chain.vertices.size() < 2) return none;
  const std::size_t next = end == 0 ? 1 : end - 1;
  const Vector2d d = chain.vertices[end].position - chain.vertices[next].position;
  const double length = d.norm();
  return length > 0 ? Vector2d(d / length) : none;
}

FieldChain MakeFieldChain(const Chain& chain, const ModelFrame& frame, double z) {
  const auto place = [&](const Vector2d& p) {
    const Vector2d q = frame.ToModel(p);
    return Vector3d(q.x(), q.y(), z);
  };
  FieldChain field;
  const std::size_t n = chain.vertices.size();
  if (n == 1) {
    const SkeletonVertex& disc = chain.vertices[0];
    field.points.push_back({place(disc.position), frame.scale * disc.radius, 1});
    return field;
  }
  std::vector<Vector2d> positions;
  for (const SkeletonVertex& v : chain.vertices) positions.push_back(v.position);
  for (const std::size_t end : {std::size_t{0}, n - 1}) {
    const double radius = chain.vertices[end].radius;
    positions[end] += kCapShift * radius * EndDirection(chain, end);
    field.points.push_back({place(positions[end]), frame.scale * kCapRadius * radius, kCapWeight});
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    field.segments.push_back({place(positions[i]), place(positions[i + 1]),
                              frame.scale * chain.vertices[i].radius,
                              frame.scale * chain.vertices[i + 1].radius});
  }
  return field;
}

}  // namespace lascaux

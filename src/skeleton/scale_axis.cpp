#include "skeleton/scale_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "skeleton/index.h"
#include "skeleton/tree.h"

namespace lascaux {
namespace {

/// How many discs along the tree are asked, before all are, whether one of them alone covers a
/// leaf.
constexpr int kNearbyDiscs = 96;
/// Uncovered arcs shorter than this, in radians, are rounding.
constexpr double kArcSlack = 1e-9;

class Peeler {
 public:
  Peeler(const Skeleton& axis, double scale)
      : axis_(axis),
        scale_(scale),
        neighbours_(Neighbours(axis)),
        alive_(axis.vertices.size(), 1),
        degree_(axis.vertices.size()),
        mark_(axis.vertices.size(), -1) {
    for (std::size_t v = 0; v < degree_.size(); ++v) {
      degree_[v] = static_cast<int>(neighbours_[v].size());
    }
  }

  std::vector<char> Peel() {
    std::vector<int> leaves;
    for (std::size_t v = 0; v < degree_.size(); ++v) {
      if (degree_[v] == 1) leaves.push_back(static_cast<int>(v));
    }
    // A leaf that shows once shows for ever, so each is asked once.
    for (std::size_t head = 0; head < leaves.size(); ++head) {
      const int leaf = leaves[head];
      if (degree_[Index(leaf)] != 1 || !(CoveredNearby(leaf) || CoveredByUnion(leaf))) continue;
      alive_[Index(leaf)] = 0;
      for (const int w : neighbours_[Index(leaf)]) {
        if (alive_[Index(w)] && --degree_[Index(w)] == 1) leaves.push_back(w);
      }
    }
    return alive_;
  }

 private:
  bool Covers(int by, int disc) const {
    const double room =
        scale_ * (axis_.vertices[Index(by)].radius - axis_.vertices[Index(disc)].radius);
    return room >= 0 && (axis_.vertices[Index(by)].position - axis_.vertices[Index(disc)].position)
                                .squaredNorm() <= room * room;
  }

  bool CoveredNearby(int leaf) {
    std::vector<int> queue{leaf};
    mark_[Index(leaf)] = leaf;
    for (std::size_t head = 0; head < queue.size() && head < kNearbyDiscs; ++head) {
      for (const int w : neighbours_[Index(queue[head])]) {
        if (!alive_[Index(w)] || mark_[Index(w)] == leaf) continue;
        if (Covers(w, leaf)) return true;
        mark_[Index(w)] = leaf;
        queue.push_back(w);
      }
    }
    return false;
  }

  /// Exact: the arcs of the leaf's circle that lie in other discs cover the circle.
  bool CoveredByUnion(int leaf) const {
    const SkeletonVertex& disc = axis_.vertices[Index(leaf)];
    const double radius = scale_ * disc.radius;
    std::vector<std::pair<double, double>> arcs;
    for (std::size_t v = 0; v < axis_.vertices.size(); ++v) {
      if (!alive_[v] || static_cast<int>(v) == leaf) continue;
      const Eigen::Vector2d d = axis_.vertices[v].position - disc.position;
      const double other = scale_ * axis_.vertices[v].radius, distance = d.norm();
      if (distance >= radius + other || distance + other <= radius) continue;
      if (distance + radius <= other) return true;
      const double cosine =
          (distance * distance + radius * radius - other * other) / (2 * distance * radius);
      const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
      const double middle = std::atan2(d.y(), d.x());
      AddArc(middle - half, middle + half, arcs);
    }
    std::sort(arcs.begin(), arcs.end());
    double reached = -std::numbers::pi;
    for (const auto& [begin, end] : arcs) {
      if (begin > reached + kArcSlack) return false;
      reached = std::max(reached, end);
    }
    return reached >= std::numbers::pi - kArcSlack;
  }

  /// Cuts an arc at the ends of (-pi, pi].
  static void AddArc(double begin, double end, std::vector<std::pair<double, double>>& arcs) {
    constexpr double kPi = std::numbers::pi;
    if (begin < -kPi) {
      arcs.emplace_back(begin + 2 * kPi, kPi);
      begin = -kPi;
    }
    if (end > kPi) {
      arcs.emplace_back(-kPi, end - 2 * kPi);
      end = kPi;
    }
    arcs.emplace_back(begin, end);
  }

  const Skeleton& axis_;
  double scale_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<char> alive_;
  std::vector<int> degree_;
  std::vector<int> mark_;
};

}  // namespace

Skeleton ScaleAxis(const Skeleton& axis, double scale) {
  return Subtree(axis, Peeler(axis, scale).Peel());
}

}  // namespace lascaux

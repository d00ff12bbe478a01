#include "skeleton/simplify_skeleton.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "skeleton/index.h"
#include "skeleton/tree.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A branch goes when it reaches out by at most this share of the tolerance.
constexpr double kBranchShare = 0.5;
/// A tree within this share of its largest disc is that disc.
constexpr double kDiscShare = 0.02;
/// Slopes of the radius are taken over this share of it: neighbouring Voronoi vertices zigzag.
constexpr double kSlopeWindow = 0.25;
/// The radius of a medial axis changes by at most 1 a unit of length.
constexpr double kSteepest = 0.999;

/// What the outline of the discs of one path looks like at each of them: a point on either side.
struct Contour {
  std::vector<std::array<Vector2d, 2>> sides;
  std::vector<double> tolerance;
};

/// `tolerance` in radii, of the median one or twice the disc's own, whichever is less.
struct Tolerance {
  double share, median;
  double For(const SkeletonVertex& disc) const { return share * std::min(median, 2 * disc.radius); }
};

Contour ContourOf(const Skeleton& axis, const std::vector<int>& path, const Tolerance& tolerance) {
  const int n = static_cast<int>(path.size());
  Contour contour;
  for (int i = 0; i < n; ++i) {
    const SkeletonVertex& disc = axis.vertices[Index(path[Index(i)])];
    int before = i, after = i;
    const auto far = [&](int j) {
      return (axis.vertices[Index(path[Index(j)])].position - disc.position).norm() >
             kSlopeWindow * disc.radius;
    };
    while (before > 0 && !far(before)) --before;
    while (after + 1 < n && !far(after)) ++after;
    const SkeletonVertex &a = axis.vertices[Index(path[Index(before)])],
                         &b = axis.vertices[Index(path[Index(after)])];
    const double length = (b.position - a.position).norm();
    Vector2d along = Vector2d::UnitX();
    double slope = 0;
    if (length > 0) {
      along = (b.position - a.position) / length;
      slope = std::clamp((b.radius - a.radius) / length, -kSteepest, kSteepest);
    }
    const Vector2d across(-along.y(), along.x());
    const double sine = std::sqrt(1 - slope * slope);
    contour.sides.push_back({disc.position + disc.radius * (sine * across - slope * along),
                             disc.position + disc.radius * (-sine * across - slope * along)});
    contour.tolerance.push_back(tolerance.For(disc));
  }
  return contour;
}

/// Greedy removal along one path; returns the positions in the path that stay.
class PathSimplifier {
 public:
  PathSimplifier(const Skeleton& axis, const std::vector<int>& path, Contour contour)
      : axis_(axis),
        path_(path),
        contour_(std::move(contour)),
        before_(path.size()),
        after_(path.size()),
        version_(path.size(), 0) {}

  std::vector<int> Run() {
    const int n = static_cast<int>(path_.size());
    for (int i = 0; i < n; ++i) before_[Index(i)] = i - 1, after_[Index(i)] = i + 1;
    for (int i = 1; i + 1 < n; ++i) Push(i);
    while (!queue_.empty()) {
      const Entry top = queue_.top();
      queue_.pop();
      if (top.version != version_[Index(top.index)]) continue;
      if (top.cost > 1) break;
      const int a = before_[Index(top.index)], c = after_[Index(top.index)];
      version_[Index(top.index)] = -1;
      after_[Index(a)] = c;
      before_[Index(c)] = a;
      if (a > 0) Push(a);
      if (c + 1 < n) Push(c);
    }
    std::vector<int> kept;
    for (int i = 0; i < n; i = after_[Index(i)]) kept.push_back(path_[Index(i)]);
    return kept;
  }

 private:
  struct Entry {
    double cost;
    int index, version;
    bool operator<(const Entry& other) const {
      return cost != other.cost ? cost > other.cost : index > other.index;
    }
  };

  void Push(int i) { queue_.push({Cost(i), i, ++version_[Index(i)]}); }

  /// In tolerances.
  double Cost(int i) const {
    const SkeletonVertex& a = axis_.vertices[Index(path_[Index(before_[Index(i)])])];
    const SkeletonVertex& c = axis_.vertices[Index(path_[Index(after_[Index(i)])])];
    double worst = 0;
    for (int k = before_[Index(i)]; k <= after_[Index(i)]; ++k) {
      for (const Vector2d& side : contour_.sides[Index(k)]) {
        worst =
            std::max(worst, std::abs(DistanceToCone(a, c, side)) / contour_.tolerance[Index(k)]);
      }
    }
    return worst;
  }

  const Skeleton& axis_;
  const std::vector<int>& path_;
  Contour contour_;
  std::vector<int> before_, after_, version_;
  std::priority_queue<Entry> queue_;
};

double MedianRadius(const Skeleton& axis) {
  std::vector<double> radii;
  for (const SkeletonVertex& v : axis.vertices) radii.push_back(v.radius);
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

/// How far the discs of a leaf's path reach out of the discs that are not on it.
double Protrusion(const Skeleton& axis, const std::vector<int>& path, double enough) {
  std::vector<char> on_path(axis.vertices.size(), 0);
  for (const int v : path) on_path[Index(v)] = 1;
  on_path[Index(path.back())] = 0;
  double worst = 0;
  for (const int v : path) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t w = 0; w < axis.vertices.size() && least > worst; ++w) {
      if (on_path[w]) continue;
      const SkeletonVertex &disc = axis.vertices[Index(v)], &other = axis.vertices[w];
      least = std::min(least, (disc.position - other.position).norm() + disc.radius - other.radius);
    }
    worst = std::max(worst, least);
    if (worst > enough) break;
  }
  return worst;
}

/// Removes the branch that reaches out least, while one reaches out by no more than `limit`.
Skeleton WithoutStubs(Skeleton axis, double limit) {
  while (true) {
    const std::vector<std::vector<int>> neighbours = Neighbours(axis);
    double least = limit;
    std::vector<int> stub;
    for (std::vector<int>& path : Paths(axis)) {
      if (neighbours[Index(path.front())].size() != 1) std::reverse(path.begin(), path.end());
      if (neighbours[Index(path.front())].size() != 1 || neighbours[Index(path.back())].size() == 1)
        continue;
      const double reach = Protrusion(axis, path, least);
      if (reach <= least) least = reach, stub = path;
    }
    if (stub.empty()) return axis;
    std::vector<char> keep(axis.vertices.size(), 1);
    for (std::size_t i = 0; i + 1 < stub.size(); ++i) keep[Index(stub[i])] = 0;
    axis = Subtree(axis, keep);
  }
}

/// The largest disc, when it covers all others to kDiscShare.
Skeleton CollapsedToDisc(Skeleton tree) {
  const auto largest = std::max_element(
      tree.vertices.begin(), tree.vertices.end(),
      [](const SkeletonVertex& a, const SkeletonVertex& b) { return a.radius < b.radius; });
  const SkeletonVertex disc = *largest;
  for (const SkeletonVertex& v : tree.vertices) {
    const double reach = (v.position - disc.position).norm() + v.radius;
    if (reach > disc.radius * (1 + kDiscShare)) return tree;
  }
  tree.vertices = {disc};
  tree.edges.clear();
  return tree;
}

}  // namespace

double DistanceToCone(const SkeletonVertex& a, const SkeletonVertex& b, const Vector2d& point) {
  const Vector2d d = b.position - a.position, w = point - a.position;
  const double length = d.norm();
  const double to_a = w.norm() - a.radius, to_b = (point - b.position).norm() - b.radius;
  const double sine = length > 0 ? (a.radius - b.radius) / length : 1;
  // One disc holds the other.
  if (std::abs(sine) >= 1) return std::min(to_a, to_b);
  const Vector2d along = d / length;
  const double x = w.dot(along), y = std::abs(along.x() * w.y() - along.y() * w.x());
  const double cosine = std::sqrt(1 - sine * sine);
  const double contact = cosine * x - sine * y;
  if (contact <= 0) return to_a;
  if (contact >= cosine * length) return to_b;
  return cosine * y + sine * x - a.radius;
}

Skeleton Simplify(const Skeleton& full, double tolerance) {
  if (full.vertices.size() < 2) return full;
  const double median = MedianRadius(full);
  const Skeleton axis = WithoutStubs(CollapsedToDisc(full), kBranchShare * tolerance * median);
  std::vector<char> keep(axis.vertices.size(), 0);
  std::vector<std::vector<int>> paths = Paths(axis);
  for (std::vector<int>& path : paths) {
    path = PathSimplifier(axis, path, ContourOf(axis, path, {tolerance, median})).Run();
    for (const int v : path) keep[Index(v)] = 1;
  }
  if (paths.empty()) return axis;
  Skeleton simple = Subtree(axis, keep);
  std::vector<int> image(axis.vertices.size(), -1);
  for (std::size_t v = 0, next = 0; v < keep.size(); ++v) {
    if (keep[v]) image[v] = static_cast<int>(next++);
  }
  simple.edges.clear();
  for (const std::vector<int>& path : paths) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      simple.edges.push_back({image[Index(path[i])], image[Index(path[i + 1])]});
    }
  }
  return CollapsedToDisc(std::move(simple));
}

}  // namespace lascaux

#include "skeleton/ring.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "skeleton/index.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A turn of this much at one vertex is a corner: flattened curves turn less a vertex, and an even
/// sampling that runs past a corner would cut it. Cosine of 25 degrees.
constexpr double kCornerCosine = 0.906;

bool IsCorner(const Vector2d& before, const Vector2d& here, const Vector2d& after) {
  const Vector2d in = here - before, out = after - here;
  const double lengths = in.norm() * out.norm();
  return lengths > 0 && in.dot(out) < kCornerCosine * lengths;
}

/// Indices of ring vertices that an even sampling must keep; never empty.
std::vector<int> Anchors(const Outline& outline) {
  const int n = static_cast<int>(outline.points.size());
  std::vector<int> anchors;
  for (int i = 0; i < n; ++i) {
    const int before = (i + n - 1) % n;
    if (outline.kinds[Index(i)] != outline.kinds[Index(before)] ||
        IsCorner(outline.points[Index(before)], outline.points[Index(i)],
                 outline.points[Index((i + 1) % n)])) {
      anchors.push_back(i);
    }
  }
  if (anchors.empty()) anchors.push_back(0);
  return anchors;
}

Vector2d FootOnSegment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double squared = d.squaredNorm();
  const double t = squared > 0 ? std::clamp((point - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return a + t * d;
}

}  // namespace

double DistanceToSegment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  return (point - FootOnSegment(point, a, b)).norm();
}

RingFoot NearestOnRing(const Ring& ring, const Vector2d& point) {
  RingFoot best;
  double best_squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d foot = FootOnSegment(point, ring[i], ring[(i + 1) % ring.size()]);
    const double squared = (point - foot).squaredNorm();
    if (squared < best_squared) {
      best_squared = squared;
      best.point = foot;
      best.piece = static_cast<int>(i);
    }
  }
  best.distance = std::sqrt(best_squared);
  return best;
}

double SignedDistanceToRing(const Ring& ring, const Vector2d& point) {
  const double distance = NearestOnRing(ring, point).distance;
  return Contains(ring, point) ? -distance : distance;
}

double Perimeter(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  return sum;
}

double Diagonal(const Ring& ring) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& p : ring) box.extend(p);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::vector<OutlineSample> SampleOutline(const Outline& outline, double spacing) {
  const int n = static_cast<int>(outline.points.size());
  const std::vector<int> anchors = Anchors(outline);
  std::vector<OutlineSample> samples;
  for (std::size_t k = 0; k < anchors.size(); ++k) {
    const int first = anchors[k];
    const int next = anchors[(k + 1) % anchors.size()];
    const int pieces = next > first ? next - first : next - first + n;
    const auto at = [&](int i) -> const Vector2d& {
      return outline.points[Index((first + i) % n)];
    };
    double length = 0;
    for (int i = 0; i < pieces; ++i) length += (at(i + 1) - at(i)).norm();
    const int count = std::max(1, static_cast<int>(std::ceil(length / spacing)));
    double passed = 0;
    int piece = 0;
    for (int s = 0; s < count; ++s) {
      const double target = length * s / count;
      double step = (at(piece + 1) - at(piece)).norm();
      while (piece + 1 < pieces && passed + step < target) {
        passed += step;
        ++piece;
        step = (at(piece + 1) - at(piece)).norm();
      }
      const double t = step > 0 ? std::clamp((target - passed) / step, 0.0, 1.0) : 0.0;
      samples.push_back({at(piece) + t * (at(piece + 1) - at(piece)), outline.kinds[Index(first)]});
    }
  }
  return samples;
}

}  // namespace lascaux

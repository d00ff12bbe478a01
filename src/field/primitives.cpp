#include "lascaux/field/primitives.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "segment_integral.h"

namespace lascaux {

using internal::Clip;

FieldSample Evaluate(const Segment& segment, const Eigen::Vector3d& point) {
  const Clip clip = internal::ClipToSupport(segment, point);
  if (clip.empty()) return {};
  const auto cube = internal::Cube(clip.p);
  std::array<double, 9> q{};
  std::copy(cube.begin(), cube.end(), q.begin());
  const auto [j0, j1] = internal::IntegrateSquare(internal::Square(clip.p), clip);
  // d P^3 = -(3/2) P^2 ((1 - g y) w - y u) dp / tau, and dy / (1 - g y) / tau = dy / tau0.
  const double factor = -1.5 * internal::kSegmentNorm / clip.tau0;
  return {std::max(internal::kSegmentNorm * internal::IntegrateOverLinear(q, clip), 0.0),
          factor * ((j0 - clip.slope * j1) * clip.w - j1 * clip.u)};
}

FieldSample Evaluate(const PointPrimitive& primitive, const Eigen::Vector3d& point) {
  const Eigen::Vector3d w = (point - primitive.center) / primitive.radius;
  const double p = 1 - w.squaredNorm() / 4;
  if (!(p > 0)) return {};
  const double norm = internal::kPointNorm * primitive.weight;
  return {norm * p * p * p, -1.5 * norm * p * p / primitive.radius * w};
}

Eigen::AlignedBox3d Bounds(const Segment& segment) {
  Eigen::AlignedBox3d box;
  if (segment.a == segment.b) return box;
  const auto add = [&box](const Eigen::Vector3d& center, double radius) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kSupportRadii * radius);
    box.extend(center - reach).extend(center + reach);
  };
  add(segment.a, segment.radius_a);
  add(segment.b, segment.radius_b);
  return box;
}

Eigen::AlignedBox3d Bounds(const PointPrimitive& primitive) {
  Eigen::AlignedBox3d box;
  if (!(primitive.weight > 0)) return box;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kSupportRadii * primitive.radius);
  return box.extend(primitive.center - reach).extend(primitive.center + reach);
}

namespace {

/// Radii of the ends of the pieces from the larger one down, both ends included.
std::vector<double> GeometricRadii(double large, double small) {
  std::vector<double> radii = {large};
  const double last = std::max(small, kTipRadius * large);
  // A ratio that is 3 up to rounding needs no second piece.
  const int pieces = std::max(
      1, static_cast<int>(std::ceil(std::log(large / last) / std::log(kPieceRadiusRatio) - 1e-12)));
  for (int i = 1; i < pieces; ++i)
    radii.push_back(large * std::pow(last / large, double(i) / pieces));
  if (last > small) radii.push_back(last);
  radii.push_back(small);
  return radii;
}

}  // namespace

std::vector<Segment> PreSplit(const Segment& segment) {
  std::vector<Segment> pieces;
  const bool from_b = segment.radius_b > segment.radius_a;
  const double large = std::max(segment.radius_a, segment.radius_b);
  const double small = std::min(segment.radius_a, segment.radius_b);
  const double length = (segment.b - segment.a).norm();
  if (!(length > 0) || !(large > 0)) return pieces;

  // Cuts as fractions of the length from the larger end, where the radius is large + t (small -
  // large).
  std::vector<double> cuts = {0};
  const std::vector<double> radii = GeometricRadii(large, small);
  for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
    const double end = i + 2 == radii.size() ? 1 : (large - radii[i + 1]) / (large - small);
    const double begin = cuts.back();
    // The smaller radius: each of the parts has at least that. A tip has no such length and stays
    // whole.
    const bool tip = radii[i + 1] < kTipRadius * large;
    const double longest =
        kPieceLengthRadii * (tip ? std::numeric_limits<double>::infinity() : radii[i + 1]);
    const int parts =
        std::max(1, static_cast<int>(std::ceil((end - begin) * length / longest - 1e-12)));
    for (int k = 1; k < parts; ++k) cuts.push_back(begin + (end - begin) * k / parts);
    cuts.push_back(end);
  }
  if (from_b) {
    std::reverse(cuts.begin(), cuts.end());
    for (double& t : cuts) t = 1 - t;
  }
  const auto at = [&](double t) -> Eigen::Vector3d {
    return t == 1 ? segment.b : Eigen::Vector3d(segment.a + t * (segment.b - segment.a));
  };
  const auto radius_at = [&](double t) {
    return t == 1 ? segment.radius_b : segment.radius_a + t * (segment.radius_b - segment.radius_a);
  };
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    pieces.push_back({at(cuts[i]), at(cuts[i + 1]), radius_at(cuts[i]), radius_at(cuts[i + 1])});
  }
  return pieces;
}

}  // namespace lascaux

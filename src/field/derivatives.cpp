#include "lascaux/field/derivatives.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "segment_integral.h"

namespace lascaux {
namespace {

using internal::Clip;
using internal::kSegmentNorm;
using Polynomial = std::array<double, 9>;

template <std::size_t kSize>
Polynomial Extend(const std::array<double, kSize>& q) {
  Polynomial extended{};
  std::copy(q.begin(), q.end(), extended.begin());
  return extended;
}

/// y q, for q of degree 7 at most.
Polynomial TimesY(const Polynomial& q, const Clip& clip) {
  Polynomial product{};
  product[0] = clip.middle * q[0];
  for (std::size_t j = 1; j < q.size(); ++j) {
    product[j] = clip.middle * q[j] + clip.half * q[j - 1];
  }
  return product;
}

/// INT q dy.
double Integrate(const Polynomial& q, const Clip& clip) {
  double sum = 0;
  for (std::size_t j = 0; j < q.size(); j += 2) sum += 2.0 / static_cast<double>(j + 1) * q[j];
  return clip.half * sum;
}

}  // namespace

SegmentDerivatives Differentiate(const Segment& segment, const Eigen::Vector3d& point) {
  SegmentDerivatives result;
  const Clip clip = internal::ClipToSupport(segment, point);
  if (clip.empty()) return result;
  const Polynomial square = Extend(internal::Square(clip.p));
  const Polynomial cube = Extend(internal::Cube(clip.p));
  const auto [j0, j1] = internal::IntegrateSquare(internal::Square(clip.p), clip);
  result.sample.value = std::max(kSegmentNorm * IntegrateOverLinear(cube, clip), 0.0);
  result.sample.gradient =
      -1.5 * kSegmentNorm / clip.tau0 * ((j0 - clip.slope * j1) * clip.w - j1 * clip.u);

  // With t the fraction of the length from the larger end: t ds / radius^2 = y / (length (1 - g y))
  // dy.
  const double y2 = IntegrateOverLinear(TimesY(TimesY(square, clip), clip), clip);
  const Eigen::Vector3d d_far =
      (result.sample.value * clip.u + 1.5 * kSegmentNorm * (j1 * clip.w - y2 * clip.u)) /
      clip.length;
  const Eigen::Vector3d d_near = -result.sample.gradient - d_far;

  Polynomial swelling;  // d (P^3 / radius) times radius^2
  for (std::size_t j = 0; j < swelling.size(); ++j) swelling[j] = 6 * square[j] - 7 * cube[j];
  const double d_radius_far =
      kSegmentNorm * IntegrateOverLinear(TimesY(swelling, clip), clip) / clip.length;
  const double d_radius_near = kSegmentNorm * Integrate(swelling, clip) / clip.tau0 - d_radius_far;

  std::tie(result.d_a, result.d_b) =
      clip.from_b ? std::pair(d_far, d_near) : std::pair(d_near, d_far);
  std::tie(result.d_radius_a, result.d_radius_b) =
      clip.from_b ? std::pair(d_radius_far, d_radius_near) : std::pair(d_radius_near, d_radius_far);
  return result;
}

PointDerivatives Differentiate(const PointPrimitive& primitive, const Eigen::Vector3d& point) {
  PointDerivatives result;
  result.sample = Evaluate(primitive, point);
  result.d_center = -result.sample.gradient;
  const double p = 1 - ((point - primitive.center) / primitive.radius).squaredNorm() / 4;
  if (!(p > 0)) return result;
  result.d_radius =
      6 * internal::kPointNorm * primitive.weight * p * p * (1 - p) / primitive.radius;
  result.d_weight = internal::kPointNorm * p * p * p;
  return result;
}

}  // namespace lascaux

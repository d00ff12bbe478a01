#include "segment_integral.h"

#include <algorithm>
#include <cmath>

namespace lascaux::internal {
namespace {

/// Below this share of the larger radius the end of a segment counts as this share: keeps y finite
/// at tips. What is cut away is smaller than rounding everywhere but at the tip itself.
constexpr double kLeastRadius = 1e-12;

/// mu_8(z) = INT xi^8 / (1 - kappa xi) over [-1, 1] = SUM 2 z^i / (2 i + 9), z = kappa^2 in [0, 1).
///
/// Up to kappa = 1/2 its Padé approximant [5/5] (relative error 7e-14), which has no cancellation
/// at 0; above, the closed form, which has none there: the two differ by less than 3e-13.
double TailMoment(double z) {
  if (z <= 0.25) {
    constexpr std::array<double, 6> kUp = {0.2222222222222222,  -0.546151166840822,
                                           0.4749370113354788,  -0.17063770626989017,
                                           0.02092877719770156, -5.002317055784647e-07};
    constexpr std::array<double, 6> kDown = {1.0,
                                             -3.2758620689655173,
                                             4.125159642401021,
                                             -2.475095785440613,
                                             0.6994835915375646,
                                             -0.07327923339917343};
    double up = kUp.back(), down = kDown.back();
    for (std::size_t k = 1; k < kUp.size(); ++k) {
      const std::size_t i = kUp.size() - 1 - k;
      up = up * z + kUp[i];
      down = down * z + kDown[i];
    }
    return up / down;
  }
  const double kappa = std::sqrt(z);
  const double mu0 = 2 * std::atanh(kappa) / kappa;
  return ((((mu0 - 2) / z - 2.0 / 3) / z - 2.0 / 5) / z - 2.0 / 7) / z;
}

}  // namespace

Clip ClipToSupport(const Segment& segment, const Eigen::Vector3d& point) {
  Clip clip;
  clip.from_b = segment.radius_b > segment.radius_a;
  const Eigen::Vector3d& from = clip.from_b ? segment.b : segment.a;
  const Eigen::Vector3d along = (clip.from_b ? segment.a : segment.b) - from;
  clip.tau0 = std::max(segment.radius_a, segment.radius_b);
  const double tau1 = std::min(segment.radius_a, segment.radius_b);
  clip.length = along.norm();
  if (!(clip.length > 0) || !(clip.tau0 > 0)) return clip;

  clip.u = along / clip.length;
  clip.w = (point - from) / clip.tau0;
  clip.slope = (tau1 - clip.tau0) / clip.length;
  const double g = clip.slope;
  const double y_end = clip.length / std::max(tau1, kLeastRadius * clip.tau0);

  const double x = clip.w.dot(clip.u);
  // From the vector itself: |w|^2 - x^2 would cancel beside the axis.
  const double h2 = (clip.w - x * clip.u).squaredNorm();
  const double e = 1 + g * x;
  const double ee = e * e + g * g * h2;
  const double s = 4 * ee - h2;
  if (!(s > 0) || !(ee > 0)) return clip;

  const double centre = (x * e + g * h2) / ee;
  const double reach = std::sqrt(s) / ee;
  const double c2 = ee / 4;
  const double low = std::max(-centre, -reach), high = std::min(y_end - centre, reach);
  clip.half = std::max((high - low) / 2, 0.0);
  const double m = (low + high) / 2;
  clip.middle = centre + m;
  clip.p = {s / (4 * ee) - c2 * m * m, -2 * c2 * m * clip.half, -c2 * clip.half * clip.half};
  // y >= 0 and g <= 0 on the interval: the denominator is at least 1.
  clip.scale = 1 - g * clip.middle;
  clip.kappa = g * clip.half / clip.scale;
  return clip;
}

std::array<double, 5> Square(const std::array<double, 3>& p) {
  return {p[0] * p[0], 2 * p[0] * p[1], p[1] * p[1] + 2 * p[0] * p[2], 2 * p[1] * p[2],
          p[2] * p[2]};
}

std::array<double, 7> Cube(const std::array<double, 3>& p) {
  const auto a = Square(p);
  return {a[0] * p[0],
          a[0] * p[1] + a[1] * p[0],
          a[0] * p[2] + a[1] * p[1] + a[2] * p[0],
          a[1] * p[2] + a[2] * p[1] + a[3] * p[0],
          a[2] * p[2] + a[3] * p[1] + a[4] * p[0],
          a[3] * p[2] + a[4] * p[1],
          a[4] * p[2]};
}

double IntegrateOverLinear(const std::array<double, 9>& q, const Clip& clip) {
  // Moments obey mu_j = (2 / (j + 1) for even j) + kappa mu_{j+1}; run backwards, which is stable,
  // and folded into the coefficients.
  double b = q[0], sum = 2 * b;
  for (std::size_t j = 1; j < 8; ++j) {
    b = q[j] + clip.kappa * b;
    if (j % 2 == 0) sum += 2.0 / static_cast<double>(j + 1) * b;
  }
  b = q[8] + clip.kappa * b;
  // kappa = -1 in rounding only happens at a tip, where the end of the segment was cut to
  // kLeastRadius.
  const double z = std::min(clip.kappa * clip.kappa, 1 - 1e-15);
  return clip.half / clip.scale * (sum + b * TailMoment(z));
}

PlainMoments IntegrateSquare(const std::array<double, 5>& square, const Clip& clip) {
  const double j0 = clip.half * (2 * square[0] + 2.0 / 3 * square[2] + 2.0 / 5 * square[4]);
  const double j1 =
      clip.half * clip.half * (2.0 / 3 * square[1] + 2.0 / 5 * square[3]) + clip.middle * j0;
  return {j0, j1};
}

}  // namespace lascaux::internal

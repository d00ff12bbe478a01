#pragma once

#include <Eigen/Core>
#include <array>

#include "lascaux/field/primitives.h"

/// @file
/// The one-dimensional integrals behind a segment's field, in double precision.
///
/// With tau0 the radius and A the place of the larger end, u the direction away from it,
/// g = d radius / d s <= 0 and y = s / radius(s): radius = tau0 / (1 - g y), ds / radius =
/// dy / (1 - g y), and the kernel's polynomial becomes
///     P(y) = 1 - |(1 - g y) w - y u|^2 / 4,   w = (p - A) / tau0,
/// a quadratic in y that is concave for every slope, so that {P > 0} is one interval.

namespace lascaux::internal {

/// N0 and N of primitives.h.
inline constexpr double kPointNorm = 64.0 / 27.0;
inline constexpr double kSegmentNorm = 1.4968340312323631;

/// The part of a segment that reaches a point, mapped to xi in [-1, 1] by y = middle + half xi.
struct Clip {
  double half = 0;  ///< 0: the point is outside of the support
  double middle = 0;
  std::array<double, 3> p{};  ///< P = p[0] + p[1] xi + p[2] xi^2
  double kappa = 0;           ///< 1 - g y = scale (1 - kappa xi)
  double scale = 1;

  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  double tau0 = 0;
  double slope = 0;
  double length = 0;
  bool from_b = false;  ///< the larger end is b

  bool empty() const { return !(half > 0); }
};

/// Finds the clip interval. Empty for segments of length 0 and for points outside of the support.
Clip ClipToSupport(const Segment& segment, const Eigen::Vector3d& point);

/// P^2 and P^3, ascending powers of xi.
std::array<double, 5> Square(const std::array<double, 3>& p);
std::array<double, 7> Cube(const std::array<double, 3>& p);

/// INT q(xi) / (1 - g y) dy over the clip interval for a polynomial of degree 8, ascending powers.
double IntegrateOverLinear(const std::array<double, 9>& q, const Clip& clip);

/// INT P^2 dy and INT y P^2 dy over the clip interval.
struct PlainMoments {
  double j0 = 0, j1 = 0;
};
PlainMoments IntegrateSquare(const std::array<double, 5>& square, const Clip& clip);

}  // namespace lascaux::internal

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "lascaux/field/primitives.h"

/// @file
/// SCALIS over triangles: the skeleton of what is a sheet and not a tube.
///
///   f(p) = N INT K(|p - q| / radius(q)) dA / radius(q)^2,  N = 1 / (pi (3/4)^4)
///
/// over the triangle, with the kernel of primitives.h: an infinite sheet of one radius has its
/// surface F = 1 at that distance. Homogeneous of degree 0, additive under cutting: a mesh of
/// triangles has no seams. At a free edge the surface ends a third of the radius beyond it.
///
/// Not part of a Field: its flat parts are segments with a depth map, which leaves their outline
/// from the side as it is drawn.
///
/// Source: C. Zanni, A. Bernhardt, M. Quiblier, M.-P. Cani, "SCALe-invariant Integral Surfaces",
/// Computer Graphics Forum 32(8), 2013.

namespace lascaux {

/// A triangle whose radius varies linearly over it. Radii >= 0, not all 0. One without area
/// contributes nothing.
struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;
  std::array<double, 3> radii = {1, 1, 1};

  bool operator==(const Triangle&) const = default;
};

/// |value - exact| <= this times max(value, 0.05), for any size and any scale; while no radius is
/// below 1e-3 of the largest, or the point is at least 1e-3 of the largest radius away from the
/// smallest's corner, and no corner is nearer to the opposite edge than 1e-3 of its length.
inline constexpr double kTriangleValueError = 1e-9;

/// |gradient - exact| <= this times (|gradient| + 0.05 / largest radius), where the value's bound
/// holds.
inline constexpr double kTriangleGradientError = 1e-8;

/// Value and gradient. Along lines of one radius the integral is a polynomial between the bounds
/// where the triangle or the kernel ends; across them, in the homothetic parameter y = s /
/// radius(s), those bounds meet at roots of quadratics. Between these the integrand is analytic and
/// 12 nodes suffice, whatever the triangle's size: about 1 us.
FieldSample Evaluate(const Triangle& triangle, const Eigen::Vector3d& point);

/// The smallest box around the support; empty for triangles that contribute nothing.
Eigen::AlignedBox3d Bounds(const Triangle& triangle);

}  // namespace lascaux

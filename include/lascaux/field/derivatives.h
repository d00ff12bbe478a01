#pragma once

#include <Eigen/Core>

#include "lascaux/field/primitives.h"

/// @file
/// How a primitive's value at a point changes with the primitive: for fitting skeletons to
/// drawings.
///
/// Exact derivatives of the integrals in primitives.h, by the same product integration and as
/// accurate as the gradient there: |error| <= kSegmentGradientError times (the derivative + 0.05 /
/// radius), unless the segment is shorter than 1e-3 of its radius, where it grows as 1 / length.

namespace lascaux {

/// A segment's value, its gradient in space, and its derivatives. For segments of length 0 all are
/// 0.
///
/// d_a + d_b + gradient = 0 (translation), and point . gradient + a . d_a + b . d_b + radius_a
/// d_radius_a + radius_b d_radius_b = 0 (scale).
struct SegmentDerivatives {
  FieldSample sample;
  Eigen::Vector3d d_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d d_b = Eigen::Vector3d::Zero();
  double d_radius_a = 0, d_radius_b = 0;
};
SegmentDerivatives Differentiate(const Segment& segment, const Eigen::Vector3d& point);

/// The same for a point primitive.
struct PointDerivatives {
  FieldSample sample;
  Eigen::Vector3d d_center = Eigen::Vector3d::Zero();
  double d_radius = 0, d_weight = 0;
};
PointDerivatives Differentiate(const PointPrimitive& primitive, const Eigen::Vector3d& point);

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// @file
/// SCALIS: scale-invariant integral surfaces of points and segments, homothetic polynomial kernel
/// of degree 6.
///
/// Source: C. Zanni, A. Bernhardt, M. Quiblier, M.-P. Cani, "SCALe-invariant Integral Surfaces",
/// Computer Graphics Forum 32(8), 2013. Normalised here so that the surface of a long straight
/// segment is F = 1 at its radius.

namespace lascaux {

inline constexpr double kIsoValue = 1.0;      ///< the surface
inline constexpr double kSupportRadii = 2.0;  ///< the field is exactly 0 beyond this many radii

/// A straight piece of a skeleton whose radius varies linearly along it. a == b is allowed and
/// contributes nothing.
struct Segment {
  Eigen::Vector3d a, b;
  double radius_a = 1, radius_b = 1;

  bool operator==(const Segment&) const = default;
};

/// A single point of the skeleton, times a weight.
struct PointPrimitive {
  Eigen::Vector3d center;
  double radius = 1;
  double weight = 1;

  bool operator==(const PointPrimitive&) const = default;
};

}  // namespace lascaux

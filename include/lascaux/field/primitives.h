#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

/// @file
/// SCALIS: scale-invariant integral surfaces of points and segments, homothetic polynomial kernel
/// of degree 6.
///
/// With the kernel K(r) = (1 - r^2 / 4)^3 for r < 2, else 0:
///   point    f(p) = weight (4/3)^3 K(|p - center| / radius)
///   segment  f(p) = N INT K(|p - c(s)| / radius(s)) ds / radius(s),  N = 35 / (64 (3/4)^(7/2)),  s
///   the arc length
///
/// Both are homogeneous of degree 0: scaling space and radii together changes nothing. f >= 0, and
/// exactly 0 outside the balls of 2 radii. f of a segment is additive under cutting.
///
/// Source: C. Zanni, A. Bernhardt, M. Quiblier, M.-P. Cani, "SCALe-invariant Integral Surfaces",
/// Computer Graphics Forum 32(8), 2013. Normalised here so that the surface of a long straight
/// segment is F = 1 at its radius.

namespace lascaux {

inline constexpr double kIsoValue = 1.0;      ///< the surface
inline constexpr double kSupportRadii = 2.0;  ///< the field is exactly 0 beyond this many radii

/// A straight piece of a skeleton whose radius varies linearly along it. a == b is allowed and
/// contributes nothing.
///
/// One radius may be 0 (a tip); the field has no limit at a tip itself, and 0 is returned there.
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

/// A field value with its gradient in space.
struct FieldSample {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// |value - exact| <= this times max(value, 0.05), in double precision, for any slope and any scale
/// from 1e-12 to 1e12; while no end's radius is below 1e-3 of the other's, or the point is at least
/// 1e-3 of the larger radius away from the smaller end.
inline constexpr double kSegmentValueError = 1e-10;

/// |gradient - exact| <= this times (|gradient| + 0.05 / radius), radius the larger end's; where
/// the value's bound holds.
inline constexpr double kSegmentGradientError = 1e-9;

/// Value and gradient of one primitive. Product integration in the homothetic parameter y = s /
/// radius(s): the integrand is a polynomial over a linear function, and its clip interval is one
/// for every slope, so there is no case to tell apart; about 60 ns.
FieldSample Evaluate(const Segment& segment, const Eigen::Vector3d& point);
FieldSample Evaluate(const PointPrimitive& primitive, const Eigen::Vector3d& point);

/// The smallest box around the support; empty for primitives that contribute nothing.
Eigen::AlignedBox3d Bounds(const Segment& segment);
Eigen::AlignedBox3d Bounds(const PointPrimitive& primitive);

inline constexpr double kPieceRadiusRatio = 3;   ///< largest ratio of the radii of a piece's ends
inline constexpr double kPieceLengthRadii = 16;  ///< largest length of a piece, in its larger radii
inline constexpr double kTipRadius =
    1e-4;  ///< of a tip's last piece, relative to the segment's larger radius

/// The segment in pieces short enough for single precision, from a to b: radii in ratios of at most
/// kPieceRadiusRatio, in geometric progression, and lengths of at most kPieceLengthRadii. The
/// fields of the pieces add up to the segment's.
///
/// An end below kTipRadius is a tip: the progression stops there and one last piece, of any ratio
/// and length, goes on to it. Empty for a segment of length 0.
std::vector<Segment> PreSplit(const Segment& segment);

}  // namespace lascaux

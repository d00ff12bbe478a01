#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <utility>
#include <vector>

/// @file
/// Planar cubic Bézier curves: the one kind of curve that a drawing is made of.

namespace lascaux {

/// A cubic Bézier with control points p[0..3]; the parameter runs from 0 to 1.
struct CubicBezier {
  std::array<Eigen::Vector2d, 4> p;

  Eigen::Vector2d At(double t) const;
  Eigen::Vector2d Derivative(double t) const;
  Eigen::Vector2d SecondDerivative(double t) const;

  /// Unit tangent at the beginning and at the end, in the curve's direction; falls back to later
  /// control points where handles coincide with their ends, zero only for a curve that is one
  /// point.
  Eigen::Vector2d StartTangent() const;
  Eigen::Vector2d EndTangent() const;

  bool operator==(const CubicBezier&) const = default;
};

/// A straight line as a cubic, with handles at its thirds.
CubicBezier Line(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The same curve run through backwards.
CubicBezier Reversed(const CubicBezier& curve);

/// The pieces before and after parameter `t` (de Casteljau; together exactly the curve).
std::pair<CubicBezier, CubicBezier> Split(const CubicBezier& curve, double t);

/// Smallest box around the curve itself (not its control points).
Eigen::AlignedBox2d Bounds(const CubicBezier& curve);

/// A point of a flattened curve with the parameter that it has on it.
struct CurveSample {
  Eigen::Vector2d point;
  double t = 0;
};

/// Samples of the curve, both ends included, such that the polyline is within `tolerance` (> 0) of
/// it.
///
/// At least two samples; at most 4096. Uniform in t, their number from the bound on the second
/// derivative (Wang's formula), so the cost is known before.
std::vector<CurveSample> Flatten(const CubicBezier& curve, double tolerance);

}  // namespace lascaux

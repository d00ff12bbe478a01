#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/sketch/parts.h"

/// @file
/// Closed polylines: sampling and measuring.

namespace lascaux {

using Ring = std::vector<Eigen::Vector2d>;

/// Distance from `point` to the segment a-b.
double DistanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b);

/// The point of the ring that is nearest, and the piece that it lies on.
struct RingFoot {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  int piece = 0;
  double distance = 0;
};
RingFoot NearestOnRing(const Ring& ring, const Eigen::Vector2d& point);

/// Distance to the ring, negative inside.
double SignedDistanceToRing(const Ring& ring, const Eigen::Vector2d& point);

double Perimeter(const Ring& ring);

/// Diagonal of the bounds.
double Diagonal(const Ring& ring);

/// A sample of an outline, with the kind of the piece that begins at it or that it lies on.
struct OutlineSample {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  OutlineKind kind = OutlineKind::kDrawn;
};

/// Samples at most `spacing` (> 0) apart along the ring, even between corners; corners and ends of
/// kinds are samples.
std::vector<OutlineSample> SampleOutline(const Outline& outline, double spacing);

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/field/primitives.h"

/// @file
/// The field of a whole creature: chains of primitives, blended into parts, parts blended with
/// their parents.
///
/// Source: Ricci, "A constructive geometry for computer graphics", The Computer Journal 16(2),
/// 1973, for the blend.

namespace lascaux {

/// Primitives whose fields add: one polyline is one integral, with the points that cap it.
struct FieldChain {
  std::vector<Segment> segments;
  std::vector<PointPrimitive> points;

  bool operator==(const FieldChain&) const = default;
};

/// A part: its chains' Ricci blend, evaluated at (x, y, z0 + (z - z0) / depth_scale).
struct FieldPart {
  std::vector<FieldChain> chains;
  std::optional<int> parent;  ///< index of the part that it blends with; smaller than its own
  double z0 = 0;
  double depth_scale = 1;

  bool operator==(const FieldPart&) const = default;
};

/// F = max over root parts of f, and over parts with a parent of Ricci(f_part, f_parent).
///
/// Only a part and its parent blend, so siblings never web. The surface is F = 1, inside is F > 1.
struct Field {
  std::vector<FieldPart> parts;
  double chain_exponent = 4;  ///< Ricci exponent between the chains of a part
  double part_exponent = 4;   ///< between a part and its parent

  bool operator==(const Field&) const = default;
};

/// A field value with its gradient in space.
struct FieldSample {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// Errors with the code "bad-primitive" for everything that no field can be made of; empty when all
/// is well.
///
/// Each names its part, chain and primitive. Refused are: coordinates, radii, weights or depths
/// that are not finite; a negative radius; a segment whose radii are both 0; a point whose radius
/// is 0 or whose weight is negative; a depth scale that is not above 0; exponents outside of [1,
/// 64]; a parent that is not an earlier part. Segments of length 0 are fine.
Diagnostics Validate(const Field& field);

/// Box outside of which the field is 0; empty for a field without primitives.
Eigen::AlignedBox3d Bounds(const Field& field);

/// Value and gradient at a point, in double precision.
FieldSample Evaluate(const Field& field, const Eigen::Vector3d& point);

/// The same for one of its parts by itself.
FieldSample EvaluatePart(const Field& field, int part, const Eigen::Vector3d& point);

/// First-order signed distance to the surface F = 1 in the same unit as the field's lengths,
/// negative inside.
///
/// Exact for cylinders. +infinity where the field is 0.
double SignedDistance(const FieldSample& sample) noexcept;

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/field/depth_map.h"
#include "lascaux/field/planar_gain.h"
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

/// A part: its chains' Ricci blend, evaluated at (x, y, z0 + (z - z0) / depth_scale), or, with a
/// depth map, at (x, y, z0 + (z - middle(x, y)) steepness(x, y)).
struct FieldPart {
  std::vector<FieldChain> chains;
  std::optional<int> parent;  ///< index of the part that it blends with; smaller than its own
  double z0 = 0;
  double depth_scale = 1;
  std::optional<DepthMap> depth = std::nullopt;

  bool operator==(const FieldPart&) const = default;
};

/// F = max over root parts of f, and over parts with a parent of Ricci(f_part, f_parent).
///
/// All of it times gain(x, y), if there is one. Only a part and its parent blend, so siblings never
/// web. The surface is F = 1, inside is F > 1.
struct Field {
  std::vector<FieldPart> parts;
  double chain_exponent = 4;  ///< Ricci exponent between the chains of a part
  double part_exponent = 4;   ///< between a part and its parent
  std::optional<PlanarGain> gain;

  bool operator==(const Field&) const = default;
};

/// Errors with the code "bad-primitive" for everything that no field can be made of; empty when all
/// is well.
///
/// Each names its part, chain and primitive. Refused are: coordinates, radii, weights or depths
/// that are not finite; a negative radius; a segment whose radii are both 0; a point whose radius
/// is 0 or whose weight is negative; a depth scale that is not above 0; a depth map that is empty,
/// not finite or has a steepness that is not above 0; exponents outside of [1, 64]; a gain that is
/// empty or whose logarithm is outside of [-32, 32]; a parent that is not an earlier part. Segments
/// of length 0 are fine.
Diagnostics Validate(const Field& field);

/// Box outside of which the field is 0; empty for a field without primitives.
Eigen::AlignedBox3d Bounds(const Field& field);

/// Value and gradient at a point, in double precision.
FieldSample Evaluate(const Field& field, const Eigen::Vector3d& point);

/// The same for one of its parts by itself, without the gain.
FieldSample EvaluatePart(const Field& field, int part, const Eigen::Vector3d& point);

/// Ricci's blend (SUM f_i^n)^(1/n) of non-negative values, with its gradient; n >= 1. n = 1 is the
/// sum, and the larger n, the nearer to the maximum.
///
/// Normalised by the largest value, so that nothing overflows; integer n by multiplication, roots
/// of powers of 2 by square roots.
FieldSample BlendRicci(std::span<const FieldSample> samples, double exponent);

/// First-order signed distance to the surface F = 1, in the unit of the field's lengths, negative
/// inside.
///
/// psi = 2 sqrt(1 - 3/4 F^(2/7)) is the distance from a cylinder's axis in radii, and d = (psi - 1)
/// / |grad psi|. Exact for cylinders from 3/4 of the radius below the surface outwards; deeper than
/// that, no less than the truth. +infinity where the field is 0, -infinity above the highest value
/// on a cylinder's axis, (4/3)^(7/2) = 2.74, and where the gradient is 0 inside.
double SignedDistance(const FieldSample& sample) noexcept;

}  // namespace lascaux

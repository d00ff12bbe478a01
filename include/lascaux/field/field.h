#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lascaux/field/primitives.h"

/// @file
/// The field of a whole creature: chains of primitives, blended into parts, parts blended with their parents.
///
/// Source: Ricci, "A constructive geometry for computer graphics", The Computer Journal 16(2), 1973, for the blend.

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

/// Value and gradient at a point, in double precision.
FieldSample Evaluate(const Field& field, const Eigen::Vector3d& point);

/// The same for one of its parts by itself.
FieldSample EvaluatePart(const Field& field, int part, const Eigen::Vector3d& point);

/// First-order signed distance to the surface F = 1 in the same unit as the field's lengths, negative inside.
///
/// Exact for cylinders. +infinity where the field is 0.
double SignedDistance(const FieldSample& sample) noexcept;

}  // namespace lascaux

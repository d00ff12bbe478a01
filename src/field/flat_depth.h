#pragma once

#include <Eigen/Core>

#include "lascaux/field/field.h"

/// @file
/// From space to the flat space of a part, in which its skeleton is planar and round.

namespace lascaux::internal {

/// A point's z in the flat space, and its derivatives by the point.
struct FlatDepth {
  double z = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();
};

inline FlatDepth FlatDepthOn(const DepthMap& map, double z0, const Eigen::Vector3d& point) {
  const DepthSample depth = EvaluateDepth(map, point.head<2>());
  const double off = point.z() - depth.middle;
  FlatDepth flat{z0 + off * depth.steepness, {0, 0, depth.steepness}};
  flat.gradient.head<2>() =
      off * depth.steepness_gradient - depth.steepness * depth.middle_gradient;
  return flat;
}

inline FlatDepth Flatten(const FieldPart& part, const Eigen::Vector3d& point) {
  if (part.depth) return FlatDepthOn(*part.depth, part.z0, point);
  return {part.z0 + (point.z() - part.z0) / part.depth_scale, {0, 0, 1 / part.depth_scale}};
}

}  // namespace lascaux::internal

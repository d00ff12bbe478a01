#pragma once

#include <Eigen/Core>
#include <optional>

#include "lascaux/field/field.h"
#include "lascaux/skeleton/creature.h"

/// @file
/// The surface of one part by itself, to place others on.

namespace lascaux {

/// In sketch coordinates, z towards the viewer; the drawn side.
class PartSurface {
 public:
  explicit PartSurface(const CreaturePart& part);

  FieldSample At(const Eigen::Vector2d& point, double z) const;
  double Distance(const Eigen::Vector2d& point, double z) const;

  /// Depth at which the ray from `point` towards the viewer leaves the part, if it meets it.
  std::optional<double> Front(const Eigen::Vector2d& point) const;

  /// Outward unit normal at (point, z), y down as in the sketch; towards the viewer where there is
  /// none.
  Eigen::Vector3d Normal(const Eigen::Vector2d& point, double z) const;

  /// Middle of the part, and its thickness in z over that in the plane.
  double Middle(const Eigen::Vector2d& point) const;
  double Scale(const Eigen::Vector2d& point) const;

 private:
  Field field_;
  double reach_ = 0;
};

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <optional>

#include "lascaux/volume/mesh.h"

/// @file
/// Does a solid stand on its feet?

namespace lascaux {

/// In the mesh's unit; y is up.
struct Stability {
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< of the filled solid
  /// How far the centre of mass is, seen from above, within the convex outline of what touches the
  /// ground; negative: how far outside of it.
  double margin = 0;

  bool Stands() const noexcept { return margin > 0; }
  bool operator==(const Stability&) const = default;
};

/// Vertices at most `contact` above the lowest touch the ground. Empty for a mesh without volume
/// and for one with invalid indices or coordinates. Linear, but for sorting the touching vertices.
std::optional<Stability> MeasureStability(const Mesh& mesh, double contact);

}  // namespace lascaux

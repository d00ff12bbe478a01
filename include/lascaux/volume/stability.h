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

  /// Degrees by which it has rolled when it comes to rest: 0 where it stands, kFarthestTilt where
  /// it rolls on.
  double tilt = 0;

  bool Stands() const noexcept { return margin > 0; }
  bool operator==(const Stability&) const = default;
};

/// Beyond this many degrees it has fallen over, however it comes to rest.
inline constexpr double kFarthestTilt = 45;

/// Vertices at most `contact` above the lowest touch the ground; what does not stand rolls, without
/// sliding or swinging, over what touches the ground then. Empty for a mesh without volume, for one
/// whose centre of mass is outside its bounds (faces of no solid that nearly cancel), and for one
/// with invalid indices or coordinates. Linear, but for sorting the touching vertices: 4 ns a
/// vertex, and as much for each half a degree that it rolls.
std::optional<Stability> MeasureStability(const Mesh& mesh, double contact);

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh.h"

/// @file
/// How thin is a mesh at its thinnest?

namespace lascaux {

/// A place where two sides of a mesh are near each other, in the mesh's unit.
struct Wall {
  double thickness = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< half-way between the two sides
  std::uint32_t triangle = 0;                        ///< one of the two sides

  bool operator==(const Wall&) const = default;
};

/// The smallest distance from the middle of a triangle, straight inward, to a side that faces the
/// other way (within 60 degrees: the two faces of an edge are no wall).
///
/// Exact for the mesh as it is, but only looked for from the middles: on evenly sized triangles it
/// is at most one edge's worth of slope off the true least. Empty for a mesh with no such place,
/// and for one with invalid indices or coordinates. Triangles without area are left out. Rays end
/// where a thinner wall is known, so it takes about 0.3 us a triangle. The same bits for any number
/// of threads.
std::optional<Wall> SmallestWall(const Mesh& mesh, const Execution& execution = {});

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

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

/// The same distance for each triangle where it is less than `limit`, by triangles: about 0.2 us a
/// triangle where the limit is small.
std::vector<Wall> FindThinWalls(const Mesh& mesh, double limit, const Execution& execution = {});

/// The thinnest place below a limit of each kind.
struct ThinPlaces {
  std::optional<Wall> wall;  ///< a leg, a neck, a membrane: it breaks, or is not printed at all
  std::optional<Wall> tip;   ///< a point or a sharp edge: only its end is not printed

  bool operator==(const ThinPlaces&) const = default;
};

/// Tells walls from tips: `walls` are those of the mesh that are thinner than `limit`
/// (FindThinWalls).
///
/// Connected regions around thin places, as far as `limit` along the surface, are looked at as a
/// whole. A region is a tip when no thin place of it is farther than 3 `limit` from what is thick,
/// and when it does not hold two thick pieces together. About 0.5 us a triangle.
ThinPlaces TellThinPlaces(const Mesh& mesh, const std::vector<Wall>& walls, double limit);

/// The smallest wall, and the thin places below a limit.
struct WallFacts {
  std::optional<Wall> smallest;
  ThinPlaces thin;

  bool operator==(const WallFacts&) const = default;
};

/// SmallestWall(), and TellThinPlaces() of FindThinWalls(), which need one look at each triangle
/// together.
WallFacts MeasureWalls(const Mesh& mesh, double limit, const Execution& execution = {});

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "lascaux/volume/mesh.h"

namespace lascaux {

/// An edge of a closed chain: crossing it changes the winding number by `winding`.
struct OutlineEdge {
  Eigen::Vector2d a, b;
  int winding = 1;
  std::uint32_t group = 0;
};

/// A region: the points around which the edges of at least one group wind.
///
/// Edges may run through the region's inside; only those between inside and outside are its
/// outline.
struct Outline {
  std::vector<OutlineEdge> edges;

  Eigen::AlignedBox2d Box() const;
};

/// The projection of all triangles along z.
///
/// The sum of the triangles' boundaries, each run through counter-clockwise in the projection,
/// winds around a point as often as triangles cover it. In a closed mesh all but the edges between
/// front and back cancel, some square root of their number. All indices must be in range.
Outline OutlineOf(const Mesh& mesh);

/// The union of rings; each is a group.
Outline OutlineOf(const std::vector<std::vector<Eigen::Vector2d>>& rings);

}  // namespace lascaux

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/mesh.h"

namespace lascaux {

/// What a lattice proves of a mesh.
struct LatticeProof {
  /// HasClosedFansOnly() of corner_table.h.
  bool closed_fans = false;
  /// Triangles that may intersect others; all pairs of which one is not listed are apart but for
  /// the corners and edges that they share. Ascending. Only where all fans are closed.
  std::vector<std::uint32_t> doubtful;
  /// At the same place as an earlier vertex.
  std::int64_t coincident = 0;
};

/// Proves in linear time that a dual mesh is closed and manifold and, for nearly all triangles,
/// that they intersect nothing. Empty where the mesh is not in a lattice's order: vertices block by
/// block of 8 x 8 x 8 cells, in a block by cells.
///
/// Nothing is taken for granted: the lattice and the order of vertices and triangles decide how
/// much can be proven, not whether it is true. Indices must be in range and coordinates finite.
///
/// *Fans.* Two consecutive triangles are a quadrilateral of a lattice edge when their corners are
/// the only vertices in the four cells around it. Where all triangles at a vertex are such
/// quadrilaterals of different edges, its fan runs from face to face of its cell as the edges do:
/// which edges of a cell make one round, and how quadrilaterals are turned around it, is in a table
/// (cell_table.h). Fans of all other vertices are walked.
///
/// *Intersections.* Cells of the lattice that hold one vertex each, strictly inside, are cut into
/// tetrahedra: from the vertex over each face, whose own middle is where it is crossed by the line
/// to the next cell's vertex, to each of its edges. The tetrahedra around one lattice edge are the
/// edge's envelope; those of different edges have no inner point in common. A quadrilateral lies in
/// its edge's envelope when, seen along the edge, its two triangles do not overlap, and the plane
/// of the one that does not meet the edge would cross it between its ends. So quadrilaterals of
/// different edges can meet in their sides only.
/// Source for the envelopes: T. Ju, T. Udeshi, "Intersection-free contouring on an octree grid",
/// Pacific Graphics 2006.
std::optional<LatticeProof> ProveByLattice(const Mesh& mesh, const Lattice& lattice);

}  // namespace lascaux

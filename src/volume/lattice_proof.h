#pragma once

#include <cstdint>
#include <vector>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/mesh.h"
#include "volume/corner_table.h"

namespace lascaux {

/// What a lattice proves of a mesh.
struct LatticeProof {
  /// Triangles that may intersect others; all pairs of which one is not listed are apart but for
  /// the corners and edges that they share. Ascending.
  std::vector<std::uint32_t> doubtful;
  /// At the same place as an earlier vertex.
  std::int64_t coincident = 0;
};

/// Proves for nearly all triangles of a dual mesh that they intersect nothing, in linear time.
///
/// The mesh must have closed fans only (corner_table.h). Nothing else is taken for granted: the
/// lattice and the order of the triangles decide how much can be proven, not whether it is true.
///
/// Cells of the lattice that hold one vertex each, strictly inside, are cut into tetrahedra: from
/// the vertex over each face, whose own middle is where it is crossed by the line to the next
/// cell's vertex, to each of its edges. The tetrahedra around one lattice edge are the edge's
/// envelope; those of different edges have no inner point in common. A quadrilateral with its
/// corners in the four cells around an edge lies in the edge's envelope when, seen along the edge,
/// its two triangles do not overlap, and the plane of the one that does not meet the edge would
/// cross it between its ends. So quadrilaterals of different edges can meet in their sides only.
/// Source for the envelopes: T. Ju, T. Udeshi, "Intersection-free contouring on an octree grid",
/// Pacific Graphics 2006.
LatticeProof ProveByLattice(const Mesh& mesh, const CornerTable& table, const Lattice& lattice);

}  // namespace lascaux

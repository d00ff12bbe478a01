#pragma once

#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/field/field.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/narrow_band.h"

namespace lascaux {

/// The surface of a narrow band (iso-value 0) as one closed mesh: closed, manifold, in one piece,
/// faces outward, vertices at band.origin + band.voxel_size times their place among the voxels.
///
/// Surface nets: a vertex for each piece of surface in a cell between eight voxel centres, at the
/// mean of the points where the piece crosses the cell's edges; a quadrilateral, as two
/// consecutive triangles, for each edge that is crossed. Pieces are told apart so that no edge of
/// the mesh has four faces. Of a quadrilateral's diagonals the shorter one is taken that keeps it
/// within reach of its own edge, so that no triangles run through each other (lattice_proof.h in
/// the sources; the lattice is the voxel centres). Values within 0.004 voxel of 0 are taken for
/// that, so that no two vertices fall on one point. The same topology as OpenVDB's volumeToMesh at
/// adaptivity 0. Same bits for any number of threads.
///
/// Sources: S. Gibson, "Constrained elastic surface nets", MICCAI 1998; G. Nielson, "Dual marching
/// cubes", IEEE Visualization 2004; R. Wenger, "Isosurfaces: geometry, topology, and algorithms",
/// 2013, for the manifold ones.
///
/// Of several shells the one with the largest volume is kept; each other one, and each cavity, is
/// removed with a warning "crumb-removed" that gives place and size (beyond ten, one warning for
/// the rest), or a note where it is no larger than two voxels. Errors: "empty-mesh" where the grid
/// has no surface, "out-of-memory", "cancelled".
Outcome<Mesh> ExtractMesh(const NarrowBand& band, const Execution& execution = {});

/// The same, with the vertices on the surface of the field that the band was made of: the mean of
/// crossings lies beside a curved surface. The distances of 99 % of the vertices from F = 1 are
/// below 0.02 voxel where radii are 8 voxels and more. Vertices stay in their cells, and those that
/// share a cell where they were; the others know their directions. About 60 ns a vertex more.
Outcome<Mesh> ExtractMesh(const NarrowBand& band, const Field& field,
                          const Execution& execution = {});

/// The same for a band that was changed since it was made of the field: only vertices in `cells`
/// (one mask a block, bit by lowest voxel) go onto the field's surface. Where a band and those
/// around it are unchanged, vertices are what they would be without the change, bit by bit.
Outcome<Mesh> ExtractMesh(const NarrowBand& band, const Field& field,
                          const std::vector<VoxelMask>& cells, const Execution& execution = {});

}  // namespace lascaux

#pragma once

#include <openvdb/openvdb.h>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/mesh.h"

namespace lascaux {

/// The surface of a level set (negative inside, iso-value 0) as one closed mesh in world
/// coordinates: closed, manifold, in one piece, faces outward.
///
/// OpenVDB's volumeToMesh at adaptivity 0; of each quadrilateral's diagonals the shorter one is
/// taken, and its faces, clockwise there, are turned. Values within 0.004 voxel of 0 are taken for
/// that, so that no two vertices fall on one point.
///
/// Of several shells the one with the largest volume is kept; each other one, and each cavity, is
/// removed with a warning "crumb-removed" that gives place and size (beyond ten, one warning for
/// the rest). Errors: "empty-mesh" where the grid has no surface, "out-of-memory", "cancelled".
Outcome<Mesh> ExtractMesh(const openvdb::FloatGrid& grid, const Execution& execution = {});

}  // namespace lascaux

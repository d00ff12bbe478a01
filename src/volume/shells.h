#pragma once

#include "lascaux/base/outcome.h"
#include "lascaux/volume/mesh.h"

namespace lascaux {

/// The shell (triangles connected by corners) with the largest volume, vertices and triangles in
/// their old order; a warning "crumb-removed" for each other, the largest ten one by one, and a
/// note for those no larger than two voxels of edge `voxel`. Error "empty-mesh" where no shell has
/// a positive volume.
Outcome<Mesh> KeepLargestShell(Mesh mesh, double voxel);

}  // namespace lascaux

#pragma once

#include <openvdb/openvdb.h>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/mesh.h"

namespace lascaux {

/// The surface of a level set as one closed mesh: OpenVDB's volumeToMesh at adaptivity 0, quads cut in two, faces turned outward.
///
/// Shells other than the largest by volume are removed, each with a warning "crumb-removed".
Outcome<Mesh> ExtractMesh(const openvdb::FloatGrid& grid, const Execution& execution = {});

}  // namespace lascaux

#pragma once

#include <filesystem>

#include "lascaux/base/outcome.h"
#include "lascaux/io/mesh_file.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"

/// @file
/// glTF 2.0, binary: one file with everything in it.

namespace lascaux {

/// Writes the mesh as glTF in metres with the model's axes (Y up; the drawing's plane stays XY):
/// one node, one mesh, one primitive, so that the surface stays closed.
///
/// POSITION (with min and max), NORMAL, COLOR_0 with the linear colours of vertices or else of
/// their parts, and `_PART`, the index into the mesh's `extras.parts` of names. Metadata goes to
/// `asset.extras`. Vertices closer than 1e-7 of their distance from the origin may fall on one
/// place when millimetres become metres. options.unit is not looked at. No errors and no warnings
/// by the Khronos validator. Errors: "cannot-write", also for more than 4 GB.
Diagnostics WriteGlb(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details = {}, const MeshFileOptions& options = {});

}  // namespace lascaux

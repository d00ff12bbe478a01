#pragma once

#include <filesystem>

#include "lascaux/base/outcome.h"
#include "lascaux/io/mesh_file.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"

/// @file
/// Wavefront OBJ, text.

namespace lascaux {

/// Writes the mesh in the scene frame (the model's axes, Y up), scaled to the unit, which stands in
/// a comment: one object, one group `g NAME` for each part that has triangles, vertex normals, and
/// the parts' colours as `v x y z r g b` (sRGB, 0 to 1), which needs no second file.
///
/// Groups share the vertices, so the mesh stays closed. Numbers have the digits that read back as
/// the same floats. Error: "cannot-write".
Diagnostics WriteObj(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details = {}, const MeshFileOptions& options = {});

}  // namespace lascaux

#pragma once

#include <filesystem>

#include "lascaux/base/outcome.h"
#include "lascaux/io/mesh_file.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"

/// @file
/// PLY, binary little endian: vertices with normals and parts.

namespace lascaux {

/// Writes the mesh in the scene frame (the model's axes, Y up), scaled to the unit, which stands in
/// a comment: vertices with normals and, where there are parts, `red green blue` (sRGB) and
/// `part_id`, an index into the comments `part INDEX NAME`.
///
/// Without normals in the details they are VertexNormals(). Error: "cannot-write".
Diagnostics WritePly(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details = {}, const MeshFileOptions& options = {});

}  // namespace lascaux

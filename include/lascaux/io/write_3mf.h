#pragma once

#include <filesystem>
#include <optional>

#include "lascaux/base/outcome.h"
#include "lascaux/io/mesh_file.h"
#include "lascaux/volume/image.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"

/// @file
/// 3MF, what slicers read: a package of XML.

namespace lascaux {

struct ThreeMfOptions : MeshFileOptions {
  std::optional<Image> thumbnail = {};  ///< shown by file managers and slicers
};

/// Writes the mesh in the print frame (Z up, X = x, Y = -z, Z = y) in millimetres as one object of
/// one mesh, moved so that no coordinate is negative. Parts are base materials with their names and
/// colours, one for each triangle (core specification 1.3, so every reader takes them).
///
/// Coordinates have the digits that read back as the mesh's own floats: what was checked on the
/// mesh holds for the file. The package has no time stamps. options.unit is not looked at. Errors:
/// "cannot-write", and those of EncodePng for the thumbnail.
Diagnostics Write3mf(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details = {}, const ThreeMfOptions& options = {});

}  // namespace lascaux

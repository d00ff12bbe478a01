#pragma once

#include <filesystem>

#include "lascaux/base/outcome.h"
#include "lascaux/volume/mesh.h"

/// @file
/// STL, binary: what every slicer reads.

namespace lascaux {

/// Writes the mesh in the print frame, in millimetres: X = x, Y = -z, Z = y of the model, a
/// rotation.
///
/// Coordinates are the mesh's own floats, so what was checked on the mesh holds for the file: min Z
/// is the mesh's min y, corners that differ stay different, faces stay counter-clockwise from
/// outside. Normals are computed in double and are (0, 0, 0) for a face without area. The header
/// does not begin with "solid", by which readers take a file for the text form. Cost: 50 bytes a
/// triangle, about 1 GB/s into the page cache. Error: "cannot-write".
Diagnostics WriteStl(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace lascaux

#pragma once

#include <filesystem>

#include "lascaux/base/outcome.h"
#include "lascaux/io/units.h"
#include "lascaux/volume/mesh.h"

/// @file
/// PLY, binary little endian: vertices with normals.

namespace lascaux {

struct WritePlyOptions {
  Unit unit = Unit::kMetre;

  bool operator==(const WritePlyOptions&) const = default;
};

/// Writes the mesh in the scene frame (the model's axes, Y up), scaled to the unit, which stands in
/// a comment.
///
/// Vertex normals are means of the faces' normals weighted by area, of length 1; (0, 0, 0) for a
/// vertex in no face. Error: "cannot-write".
Diagnostics WritePly(const std::filesystem::path& path, const Mesh& mesh,
                     const WritePlyOptions& options = {});

}  // namespace lascaux

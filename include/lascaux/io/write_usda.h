#pragma once

#include <filesystem>
#include <string>

#include "lascaux/base/outcome.h"
#include "lascaux/io/mesh_file.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"
#include "lascaux/volume/up_axis.h"

/// @file
/// Universal Scene Description, text.

namespace lascaux {

struct UsdaOptions : MeshFileOptions {
  /// Path of the .vdb of the same model, relative to the stage's folder; empty for none.
  std::string volume = {};
  UpAxis volume_up = UpAxis::kY;  ///< its axes: it is turned to the stage's
  bool fog = false;               ///< it holds "density", too
};

/// Writes the mesh as a USD stage (the model's axes, `upAxis = "Y"`, `metersPerUnit` by the unit):
/// `/NAME/mesh`, a polygon mesh that is not subdivided, with its extent, right-handed faces, vertex
/// normals, `primvars:displayColor` (linear; a face or, where there are colours of vertices, a
/// vertex) and a GeomSubset of faces for each part (family "parts"); and, if options.volume is not
/// empty, `/NAME/volume`, a Volume whose fields "surface" and "density" are read from there. Its
/// purpose is "guide", so that renderers don't draw the surface twice.
///
/// The mesh must have triangles. Numbers have the digits that read back as the same floats. Error:
/// "cannot-write".
Diagnostics WriteUsda(const std::filesystem::path& path, const Mesh& mesh,
                      const MeshDetails& details = {}, const UsdaOptions& options = {});

}  // namespace lascaux

#pragma once

#include <cstddef>
#include <string_view>

#include "lascaux/base/outcome.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"

/// @file
/// Triangle meshes from files, to look at them: any bytes are safe to read.

namespace lascaux {

enum class MeshFormat : std::uint8_t { kStl, kPly, kObj, kGlb, k3mf };

/// "STL", "PLY", "OBJ", "GLB", "3MF".
const char* Name(MeshFormat format) noexcept;

/// A mesh as it stands in its file.
struct LoadedMesh {
  MeshFormat format = MeshFormat::kStl;
  /// The file's own coordinates, turned to the model's axes (Y up) where the format is Z up: a swap
  /// of axes, no rounding. Indices may point past the end where the file's do.
  Mesh mesh;
  double millimetres = 1;  ///< how many a unit of the coordinates is
  /// Names of parts, and the part of each triangle, where the file tells parts apart; no normals.
  MeshDetails details;
};

struct ReadMeshOptions {
  std::size_t max_triangles = 100'000'000;          ///< more are refused
  std::size_t max_unpacked = std::size_t{4} << 30;  ///< bytes of a packed file's model

  bool operator==(const ReadMeshOptions&) const = default;
};

/// Reads binary and text STL, PLY (text and both byte orders), OBJ, GLB and 3MF; which one it is
/// shows in the bytes. Polygons become fans of triangles.
///
/// STL and GLB have no way to say that corners are one vertex (GLB splits them where normals or
/// colours differ), so there equal positions are. STL and 3MF are Z up; GLB is in metres and OBJ
/// and PLY in what a comment "unit mm" (cm, m) says, else in millimetres; placements of nodes, of
/// components and of build items are applied. Parts are the groups of OBJ, the `part_id` of PLY,
/// the materials of 3MF and `_PART` of GLB.
///
/// Errors (input): "not-a-mesh" for bytes in no such format; "broken-mesh" with the place for a
/// file that ends too early, contradicts itself or is over the limits; "unsupported-mesh" for
/// compressed and sparse GLB and for GLB with other files. Linear in the size.
Outcome<LoadedMesh> ReadMesh(std::string_view bytes, const ReadMeshOptions& options = {});

}  // namespace lascaux

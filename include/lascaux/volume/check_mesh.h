#pragma once

#include <cstdint>
#include <optional>

#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh.h"

/// @file
/// Is a mesh one solid that a slicer takes without repair?

namespace lascaux {

/// What was counted. A figure that was not measured is empty, never 0.
struct MeshFacts {
  std::int64_t vertices = 0, triangles = 0;
  bool closed = false;    ///< every edge in an even number of faces, none open
  bool manifold = false;  ///< every edge in exactly two faces, one fan a vertex
  bool oriented = false;  ///< every edge run through once in each direction, and outward
  std::int64_t degenerate = 0;  ///< triangles without area, or with two corners at one place
  std::int64_t coincident = 0;  ///< vertices at the same place as another
  std::optional<std::int64_t> self_intersections;  ///< pairs of triangles
  int components = 0;
  std::optional<int> genus;  ///< of one closed component
  double volume = 0, area = 0;  ///< in the mesh's unit, cubed and squared

  /// Closed, manifold, oriented, one component, no degenerate or coincident elements and, if counted, no self-intersection.
  bool IsPrintable() const noexcept;

  bool operator==(const MeshFacts&) const = default;
};

/// Measures a mesh.
MeshFacts CheckMesh(const Mesh& mesh, const Execution& execution = {});

}  // namespace lascaux

#pragma once

#include <cstddef>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/mesh.h"

namespace lascaux {

/// The same solid with at most `faces` (at least 4) triangles, or with as few more as it takes to
/// stay printable (MeshFacts::IsPrintable) without turning a face over.
///
/// Edges are collapsed in the order of the planes' quadric errors; a result that is not printable
/// is thrown away and the next one has a quarter more triangles, at last those of `mesh`, which
/// must be printable. About 5 us a triangle of `mesh` for each of them. A note "more-faces" says
/// when it had to be more. Error: "cancelled".
///
/// Sources: M. Garland, P. Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH
/// 1997; CGAL, "Triangulated surface mesh simplification".
Outcome<Mesh> Simplify(const Mesh& mesh, std::size_t faces, const Execution& execution = {});

}  // namespace lascaux

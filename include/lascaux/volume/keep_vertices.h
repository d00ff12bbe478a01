#pragma once

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/mesh.h"

namespace lascaux {

/// Puts vertices of `mesh` where `before` has its own, where the two surfaces are the same: in the
/// same cell of the lattice, and less than a quarter of its size away. Both have one vertex in most
/// cells, as ExtractMesh makes them; cells with several are left alone. Linear but for sorting.
void KeepVertices(const Mesh& before, const Lattice& lattice, Mesh& mesh);

}  // namespace lascaux

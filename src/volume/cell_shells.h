#pragma once

#include "volume/block_quads.h"
#include "volume/surface_cells.h"

namespace lascaux {

/// Do quadrilaterals connect all vertices of the crossed cells? `pairs` are those that ones beside
/// cells of several pieces connect (ConnectAroundEdges).
///
/// Cells of one piece are connected where the surface crosses the face between them: the
/// quadrilateral around a crossed edge of that face has both. So bits of 64 cells tell which cells
/// of a block are connected within it, and which blocks are. Linear in the number of blocks.
bool IsOneShell(const SurfaceCells& cells, const VertexPairs& pairs);

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lascaux/volume/mesh.h"
#include "volume/surface_cells.h"

namespace lascaux {

/// Vertices that are connected.
using VertexPairs = std::vector<std::array<std::uint32_t, 2>>;

/// Where quadrilaterals go, and what they are cut by.
struct QuadTarget {
  const Eigen::Vector3f* in_cell;           ///< of each vertex, 0 to 1
  std::array<std::uint32_t, 3>* triangles;  ///< two for each of the block's quadrilaterals
};

/// Connects the vertices around those edges that end in the upper corner of a block's cells, two
/// triangles an edge. Returns which of them are connected where a cell beside the edge has several
/// vertices.
VertexPairs ConnectAroundEdges(const SurfaceCells& cells, std::size_t block,
                               const QuadTarget& target);

}  // namespace lascaux

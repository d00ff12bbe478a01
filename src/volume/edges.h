#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lascaux/volume/mesh.h"

namespace lascaux {

/// One side of a triangle, listed at its edge's smaller vertex.
struct EdgeSide {
  std::uint32_t high;  ///< the edge's larger vertex
  std::uint32_t side;  ///< 3 * triangle + k: from corner k to corner k + 1

  std::uint32_t Triangle() const noexcept { return side / 3; }
};

/// The edges of a mesh, each with the sides of triangles that run along it.
///
/// Sides from a vertex to itself are no edges and are left out. Linear in the size of the mesh; the
/// order depends on the mesh alone.
class EdgeTable {
 public:
  /// All indices must be in range; at most 2^32 / 3 triangles.
  explicit EdgeTable(const Mesh& mesh);

  std::size_t vertices() const noexcept { return first_.size() - 1; }

  /// Calls visit(low, sides) for each edge whose smaller vertex is `low`; `sides` has those along
  /// it.
  template <typename Visit>
  void ForEdgesOf(std::uint32_t low, Visit&& visit) const {
    const EdgeSide* end = sides_.data() + first_[low + 1];
    for (const EdgeSide* run = sides_.data() + first_[low]; run != end;) {
      const EdgeSide* next = run + 1;
      while (next != end && next->high == run->high) ++next;
      visit(low, std::span<const EdgeSide>(run, next));
      run = next;
    }
  }

  /// The same for all edges.
  template <typename Visit>
  void ForEdges(Visit&& visit) const {
    for (std::uint32_t low = 0; low < vertices(); ++low) ForEdgesOf(low, visit);
  }

 private:
  std::vector<std::size_t> first_;  // of each vertex's sides, one more than there are vertices
  std::vector<EdgeSide> sides_;
};

}  // namespace lascaux

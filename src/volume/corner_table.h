#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lascaux/volume/mesh.h"

namespace lascaux {

/// The corners of triangles at each vertex of a mesh, ascending: corner 3 t + k is number k of
/// triangle t.
///
/// All indices must be in range; at most 2^32 / 3 triangles. Linear in the size of the mesh.
class CornerTable {
 public:
  explicit CornerTable(const Mesh& mesh);

  std::size_t vertices() const noexcept { return first_.size() - 1; }

  std::span<const std::uint32_t> At(std::size_t vertex) const {
    return {corners_.data() + first_[vertex], corners_.data() + first_[vertex + 1]};
  }

 private:
  std::vector<std::uint32_t> first_;  // of each vertex's corners, one more than there are vertices
  std::vector<std::uint32_t> corners_;
};

/// Do the triangles with these corners at a vertex make one closed fan of at least three, turned
/// alike? With more than 64 the answer is no.
bool IsClosedFan(const Mesh& mesh, std::uint32_t vertex, std::span<const std::uint32_t> corners);

/// Do the triangles at each vertex make one closed fan of at least three, turned alike?
///
/// Then the mesh is closed and manifold, each edge is run through once in each direction, no vertex
/// is unused, and there are 3/2 times as many edges as triangles. The opposite does not hold: a
/// pillow of two triangles is closed, too.
bool HasClosedFansOnly(const Mesh& mesh, const CornerTable& table);

}  // namespace lascaux

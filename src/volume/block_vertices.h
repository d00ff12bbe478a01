#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/union_find.h"
#include "volume/surface_cells.h"

namespace lascaux {

/// The vertices of a block's crossed cells and of those one step beyond along x, y, z, and which of
/// them quadrilaterals connect.
class BlockVertices {
 public:
  /// Between cells along x, y, z.
  static constexpr std::array<std::size_t, 3> kStride = {81, 9, 1};

  /// A vertex here is a small number, or kSeveral where its cell has more than one piece.
  using Local = std::uint16_t;
  static constexpr Local kSeveral = 0xFFFF;

  BlockVertices(const SurfaceCells& cells, std::size_t block);

  /// Place of the block's cell 64 x + 8 y + z.
  static std::size_t PlaceOf(std::size_t cell) {
    return cell + cell / 8 + 9 * (cell / 64);  // 81 x + 9 y + z
  }

  /// Precondition: the cell at that place is crossed.
  Local At(std::size_t place) const { return locals_[place]; }
  std::uint32_t Vertex(Local local) const { return vertices_[local]; }
  /// Those that are alone in their cells.
  std::span<const std::uint32_t> Vertices() const { return {vertices_.data(), count_}; }

  /// Of vertices combined by "or": all others are below 1024.
  static bool IsAnySeveral(int locals) { return locals == kSeveral; }

  /// The vertex of the piece that crosses an edge (CellEdge) of the cell at a place.
  std::uint32_t VertexAtEdge(std::size_t place, std::size_t edge) const;

  /// Connects vertices that are not in cells of several.
  void Join(Local a, Local b) {
    if (parent_[a] == parent_[b]) return;
    a = Root(a);
    b = Root(b);
    parent_[a < b ? b : a] = a < b ? a : b;
  }

  /// Tells all of the block's vertices what they are connected with in here; returns pairs that
  /// are connected beyond.
  void Tell(UnionFind& sets, std::vector<std::array<std::uint32_t, 2>>& pairs);

 private:
  static constexpr std::size_t kPlaces = 9 * 9 * 9;

  void AddOwn();
  void AddBeyond(std::size_t side);
  Local Add(std::uint32_t vertex) {
    const auto local = static_cast<Local>(count_);
    vertices_[count_] = vertex;
    parent_[count_++] = local;
    return local;
  }
  Local Root(Local local) {
    while (parent_[local] != local) local = parent_[local] = parent_[parent_[local]];
    return local;
  }

  const SurfaceCells& cells_;
  std::size_t block_;
  std::size_t own_ = 0, count_ = 0;
  std::array<Local, kPlaces> locals_;
  std::array<std::uint32_t, kPlaces>
      vertices_;                       // of those that are alone in their cells, own first
  std::array<Local, kPlaces> parent_;  // not larger
};

}  // namespace lascaux

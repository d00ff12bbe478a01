#include "volume/block_vertices.h"

namespace lascaux {

BlockVertices::BlockVertices(const SurfaceCells& cells, std::size_t block)
    : cells_(cells), block_(block) {
  AddOwn();
  own_ = count_;
  for (std::size_t side = 1; side < 8; ++side) AddBeyond(side);
}

void BlockVertices::AddOwn() {
  const bool is_single = cells_.HasSinglePieces(block_);
  std::uint32_t vertex = cells_.first_vertex[block_];
  cells_.ForCells(block_, [&](std::size_t cell, std::size_t number) {
    const std::uint32_t pieces = is_single ? 1 : cells_.Pieces(number).count;
    locals_[PlaceOf(cell)] = pieces == 1 ? Add(vertex) : kSeveral;
    vertex += pieces;
  });
}

void BlockVertices::AddBeyond(std::size_t side) {
  const std::int32_t found = cells_.above[block_][side];
  if (found == kNoBlock) return;
  const auto block = static_cast<std::size_t>(found);
  const bool is_single = cells_.HasSinglePieces(block);
  const std::size_t beyond_x = side & 1, beyond_y = side >> 1 & 1, beyond_z = side >> 2;
  const std::uint64_t touching = (beyond_y == 1 ? 0xFF : ~std::uint64_t{0}) &
                                 (beyond_z == 1 ? 0x0101010101010101 : ~std::uint64_t{0});
  for (std::size_t x = 0; x < (beyond_x == 1 ? 1 : 8); ++x) {
    const std::uint64_t crossed = cells_.crossed[block][x];
    for (std::uint64_t word = crossed & touching; word != 0; word &= word - 1) {
      const auto in_layer = static_cast<std::size_t>(std::countr_zero(word));
      const std::size_t number = cells_.first[block] + cells_.in_layers[block][x] +
                                 CountBits(crossed & ((word & -word) - 1));
      const std::size_t place = PlaceOf(64 * x + in_layer) +
                                8 * (kStride[0] * beyond_x + kStride[1] * beyond_y + beyond_z);
      const bool is_alone = is_single || cells_.Pieces(number).count == 1;
      locals_[place] = is_alone ? Add(cells_.FirstVertex(block, number)) : kSeveral;
    }
  }
}

std::uint32_t BlockVertices::VertexAtEdge(std::size_t place, std::size_t edge) const {
  if (locals_[place] != kSeveral) return vertices_[locals_[place]];
  std::size_t cell = 0, side = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t along = place / kStride[axis] % 9;
    side |= along / 8 << axis;
    cell = 8 * cell + along % 8;
  }
  const auto block = static_cast<std::size_t>(cells_.above[block_][side]);
  const std::size_t number = cells_.Number(block, cell);
  return cells_.FirstVertex(block, number) + cells_.Pieces(number).of_edge[edge];
}

void BlockVertices::Tell(UnionFind& sets, std::vector<std::array<std::uint32_t, 2>>& pairs) {
  if (!cells_.HasSinglePieces(block_))
    for (std::uint32_t v = cells_.first_vertex[block_]; v < cells_.first_vertex[block_ + 1]; ++v)
      sets.Hang(v, v);
  for (std::size_t i = 0; i < own_; ++i)
    sets.Hang(vertices_[i], vertices_[Root(static_cast<Local>(i))]);
  for (std::size_t i = own_; i < count_; ++i) {
    const Local root = Root(static_cast<Local>(i));
    if (root < own_) pairs.push_back({vertices_[root], vertices_[i]});
  }
}

}  // namespace lascaux

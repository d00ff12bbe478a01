#include "volume/block_vertices.h"

namespace lascaux {

BlockVertices::BlockVertices(const SurfaceCells& cells, std::size_t block)
    : cells_(cells), block_(block) {
  AddOwn();
  for (std::size_t side = 1; side < 8; ++side) AddBeyond(side);
}

void BlockVertices::AddOwn() {
  std::uint32_t vertex = cells_.first_vertex[block_];
  if (cells_.HasSinglePieces(block_)) {
    cells_.ForCells(block_,
                    [&](std::size_t cell, std::size_t) { vertices_[PlaceOf(cell)] = vertex++; });
    return;
  }
  has_several_ = true;
  cells_.ForCells(block_, [&](std::size_t cell, std::size_t number) {
    const std::uint32_t pieces = cells_.Pieces(number).count;
    vertices_[PlaceOf(cell)] = pieces == 1 ? vertex : kSeveral;
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
  std::uint32_t* const at =
      vertices_.data() + 8 * (kStride[0] * beyond_x + kStride[1] * beyond_y + beyond_z);
  for (std::size_t x = 0; x < (beyond_x == 1 ? 1 : 8); ++x) {
    const std::uint64_t crossed = cells_.crossed[block][x];
    for (std::uint64_t word = crossed & touching; word != 0; word &= word - 1) {
      const auto in_layer = static_cast<std::size_t>(std::countr_zero(word));
      const std::size_t in_block =
          cells_.in_layers[block][x] + CountBits(crossed & ((word & -word) - 1));
      std::uint32_t& vertex = at[PlaceOf(64 * x + in_layer)];
      vertex = cells_.first_vertex[block] + static_cast<std::uint32_t>(in_block);
      if (is_single) continue;
      const std::size_t number = cells_.first[block] + in_block;
      const bool is_alone = cells_.Pieces(number).count == 1;
      vertex = is_alone ? cells_.FirstVertex(block, number) : kSeveral;
      has_several_ = has_several_ || !is_alone;
    }
  }
}

std::uint32_t BlockVertices::VertexAtEdge(std::size_t place, std::size_t edge) const {
  if (vertices_[place] != kSeveral) return vertices_[place];
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

}  // namespace lascaux

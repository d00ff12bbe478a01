#include "volume/cell_shells.h"

#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/union_find.h"
#include "volume/sign_planes.h"

namespace lascaux {
namespace {

constexpr std::uint64_t kFirstY = 0xFF, kFirstZ = 0x0101010101010101;  // bits with y = 0, z = 0

/// Which cells' lower faces across x, y, z the surface crosses; beyond the block, those of the
/// first cells there.
struct Faces {
  std::array<std::uint64_t, 9> x;
  VoxelMask y, z;
  VoxelMask beyond_y, beyond_z;

  Faces(const SurfaceCells& cells, std::size_t block) {
    const auto crossed = [](std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
      return (a | b | c | d) & ~(a & b & c & d);
    };
    ForLayers(cells, block, [&](std::size_t i, const SignPlanes& low, const SignPlanes& high) {
      x[i] = crossed(low.at, low.y, low.z, low.yz);
      x[i + 1] = crossed(high.at, high.y, high.z, high.yz);
      y[i] = crossed(low.at, low.z, high.at, high.z);
      z[i] = crossed(low.at, low.y, high.at, high.y);
      beyond_y[i] = crossed(low.y, low.yz, high.y, high.yz) >> 56;
      beyond_z[i] = crossed(low.z, low.yz, high.z, high.yz) >> 7 & kFirstZ;
    });
  }

  /// Is one of `own` connected with one of `other`, cells of the next block along an axis?
  bool Connect(std::size_t axis, const VoxelMask& own, const VoxelMask& other) const {
    if (axis == 0) return (own[7] & other[0] & x[8]) != 0;
    std::uint64_t both = 0;
    for (std::size_t i = 0; i < 8; ++i)
      both |= other[i] & (axis == 1 ? own[i] >> 56 & beyond_y[i] : own[i] >> 7 & beyond_z[i]);
    return both != 0;
  }
};

/// Cells of one piece.
VoxelMask SingleCells(const SurfaceCells& cells, std::size_t block) {
  VoxelMask mask = cells.crossed[block];
  if (cells.HasSinglePieces(block)) return mask;
  cells.ForCells(block, [&](std::size_t cell, std::size_t number) {
    if (cells.Pieces(number).count > 1) mask[cell / 64] &= ~(std::uint64_t{1} << cell % 64);
  });
  return mask;
}

/// The cells of a block that are connected within it.
class BlockFill {
 public:
  BlockFill(const Faces& faces, const VoxelMask& cells) : cells_(cells) {
    for (std::size_t i = 0; i < 8; ++i) {
      from_x_[i] = i > 0 ? faces.x[i] & cells[i] & cells[i - 1] : 0;
      from_y_[i] = faces.y[i] & ~kFirstY & cells[i] & cells[i] << 8;
      from_z_[i] = faces.z[i] & ~kFirstZ & cells[i] & cells[i] << 1;
    }
  }

  /// All that are connected with the first cell.
  VoxelMask FromFirst() const {
    VoxelMask filled{};
    std::size_t first = 0;
    while (cells_[first] == 0) ++first;
    filled[first] = InLayer(first, cells_[first] & -cells_[first]);
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      const auto grow = [&](std::size_t i, std::uint64_t more) {
        if ((more & ~filled[i]) == 0) return;
        filled[i] = InLayer(i, filled[i] | more);
        has_grown = true;
      };
      for (std::size_t i = 1; i < 8; ++i) grow(i, filled[i - 1] & from_x_[i]);
      for (std::size_t i = 7; i-- > 0;) grow(i, filled[i + 1] & from_x_[i + 1]);
    }
    return filled;
  }

 private:
  std::uint64_t InLayer(std::size_t i, std::uint64_t filled) const {
    const std::uint64_t from_y = from_y_[i], from_z = from_z_[i];
    for (std::uint64_t before = 0; before != filled && filled != cells_[i];) {
      before = filled;
      filled |= (filled << 8 & from_y) | (filled & from_y) >> 8;
      filled |= (filled << 1 & from_z) | (filled & from_z) >> 1;
    }
    return filled;
  }

  VoxelMask cells_, from_x_, from_y_, from_z_;  // connected with the one before along an axis
};

bool IsNone(const VoxelMask& mask) {
  return std::all_of(mask.begin(), mask.end(), [](std::uint64_t word) { return word == 0; });
}

/// The sets of connected cells of one piece in a block where they are not one.
struct DividedBlock {
  std::size_t block;
  std::vector<VoxelMask> sets;
  std::uint32_t second = 0;  ///< number of the second set
};

/// Sets of connected cells are numbered: the first of each block by the block, others behind, then
/// the vertices of cells of several pieces.
class Shells {
 public:
  Shells(const SurfaceCells& cells, const VertexPairs& pairs)
      : cells_(cells), pairs_(pairs), state_(cells.size()) {}

  bool IsOne() {
    DivideBlocks();
    FindAlone();
    UnionFind joined(first_alone_ + alone_.size());
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t b) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if ((state_[b] >> axis & 1) != 0) JoinBeyond(b, axis, joined);
    });
    for (const auto& [a, b] : pairs_) joined.Join(NumberOf(a), NumberOf(b));
    std::size_t shells = 0;
    for (std::uint32_t i = 0; i < first_alone_ + alone_.size(); ++i) {
      const bool is_empty = i < cells_.size() && (state_[i] & kEmpty) != 0;
      shells += joined.IsRoot(i) && !is_empty ? 1 : 0;
    }
    return shells == 1;
  }

 private:
  // Bits of a block's state, beside those of the axes along which it is connected with the next.
  static constexpr std::uint8_t kDivided = 8, kEmpty = 16;

  void DivideBlocks() {
    tbb::combinable<std::vector<DividedBlock>> found;
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t b) {
      state_[b] = kEmpty;
      if (cells_.IsEmpty(b)) return;
      const Faces faces(cells_, b);
      DividedBlock divided{b, {}};
      VoxelMask left = SingleCells(cells_, b);
      while (!IsNone(left)) {
        divided.sets.push_back(BlockFill(faces, left).FromFirst());
        for (std::size_t x = 0; x < 8; ++x) left[x] &= ~divided.sets.back()[x];
      }
      state_[b] =
          static_cast<std::uint8_t>((faces.x[8] != 0 ? 1 : 0) | (IsNone(faces.beyond_y) ? 0 : 2) |
                                    (IsNone(faces.beyond_z) ? 0 : 4));
      if (divided.sets.size() == 1 && cells_.HasSinglePieces(b)) return;
      state_[b] =
          static_cast<std::uint8_t>(state_[b] | kDivided | (divided.sets.empty() ? kEmpty : 0));
      found.local().push_back(std::move(divided));
    });
    found.combine_each([this](const std::vector<DividedBlock>& some) {
      divided_.insert(divided_.end(), some.begin(), some.end());
    });
    std::sort(divided_.begin(), divided_.end(),
              [](const DividedBlock& a, const DividedBlock& b) { return a.block < b.block; });
    first_alone_ = static_cast<std::uint32_t>(cells_.size());
    for (DividedBlock& block : divided_) {
      block.second = first_alone_;
      if (!block.sets.empty()) first_alone_ += static_cast<std::uint32_t>(block.sets.size() - 1);
    }
  }

  void FindAlone() {
    for (const auto& pair : pairs_) {
      for (const std::uint32_t vertex : pair)
        if (!SetOf(vertex)) alone_.push_back(vertex);
    }
    std::sort(alone_.begin(), alone_.end());
    alone_.erase(std::unique(alone_.begin(), alone_.end()), alone_.end());
  }

  std::uint32_t NumberOf(std::uint32_t vertex) const {
    if (const auto set = SetOf(vertex)) return *set;
    const auto at = std::lower_bound(alone_.begin(), alone_.end(), vertex);
    return first_alone_ + static_cast<std::uint32_t>(at - alone_.begin());
  }

  /// The set of a vertex's cell, if it is of one piece.
  std::optional<std::uint32_t> SetOf(std::uint32_t vertex) const {
    const auto next =
        std::upper_bound(cells_.first_vertex.begin(), cells_.first_vertex.end(), vertex);
    const auto block = static_cast<std::size_t>(next - cells_.first_vertex.begin()) - 1;
    std::optional<std::uint32_t> set;
    std::uint32_t first = cells_.first_vertex[block];
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      const std::uint32_t pieces = cells_.Pieces(number).count;
      if (first == vertex && pieces == 1) {
        ForSets(block, [&](std::uint32_t n, const VoxelMask& mask) {
          if ((mask[cell / 64] >> cell % 64 & 1) != 0) set = n;
        });
      }
      first += pieces;
    });
    return set;
  }

  /// Calls visit(number, cells) for each of a block's sets.
  template <typename Visit>
  void ForSets(std::size_t block, Visit&& visit) const {
    const auto first = static_cast<std::uint32_t>(block);
    if ((state_[block] & kDivided) == 0) return visit(first, cells_.crossed[block]);
    const auto divided =
        std::lower_bound(divided_.begin(), divided_.end(), block,
                         [](const DividedBlock& a, std::size_t b) { return a.block < b; });
    for (std::uint32_t i = 0; i < divided->sets.size(); ++i)
      visit(i == 0 ? first : divided->second + i - 1, divided->sets[i]);
  }

  void JoinBeyond(std::size_t block, std::size_t axis, UnionFind& joined) const {
    const std::int32_t found = cells_.above[block][std::size_t{1} << axis];
    if (found == kNoBlock) return;
    const auto beyond = static_cast<std::size_t>(found);
    if (((state_[block] | state_[beyond]) & kDivided) == 0)
      return joined.Join(static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(beyond));
    const Faces faces(cells_, block);
    ForSets(block, [&](std::uint32_t n, const VoxelMask& own) {
      ForSets(beyond, [&](std::uint32_t m, const VoxelMask& other) {
        if (faces.Connect(axis, own, other)) joined.Join(n, m);
      });
    });
  }

  const SurfaceCells& cells_;
  const VertexPairs& pairs_;
  std::vector<std::uint8_t> state_;  // of each block
  std::vector<DividedBlock> divided_;
  std::uint32_t first_alone_ = 0;
  std::vector<std::uint32_t> alone_;  // vertices of cells of several pieces
};

}  // namespace

bool IsOneShell(const SurfaceCells& cells, const VertexPairs& pairs) {
  return Shells(cells, pairs).IsOne();
}

}  // namespace lascaux

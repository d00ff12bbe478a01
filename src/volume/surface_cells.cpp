#include "volume/surface_cells.h"

#include <tbb/parallel_for.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <atomic>

#include "volume/block_map.h"

namespace lascaux {
namespace {

constexpr std::uint64_t kLastZ = 0x8080808080808080;  // the bits with z = 7
constexpr VoxelMask kNoVoxels{};
constexpr VoxelMask kAllVoxels = [] {
  VoxelMask mask{};
  for (std::uint64_t& word : mask) word = ~std::uint64_t{0};
  return mask;
}();

/// Bit i is set where values[i] is below 0.
std::uint64_t BelowZero(const float* values) {
  std::uint64_t word = 0;
#if defined(__SSE2__)
  for (std::size_t i = 0; i < 64; i += 4) {
    const int four = _mm_movemask_ps(_mm_cmplt_ps(_mm_loadu_ps(values + i), _mm_setzero_ps()));
    word |= static_cast<std::uint64_t>(four) << i;
  }
#else
  for (std::size_t i = 0; i < 64; ++i) word |= static_cast<std::uint64_t>(values[i] < 0) << i;
#endif
  return word;
}

VoxelMask InsideOf(const float* values) {
  VoxelMask mask{};
  for (std::size_t x = 0; x < 8; ++x) mask[x] = BelowZero(values + 64 * x);
  return mask;
}

/// The planes of 64 cells' lower corners along x, and of those one step along y, z and both.
struct SignPlanes {
  std::uint64_t at, y, z, yz;
};

/// Signs of a block's voxels and of those one step beyond.
class SignsAround {
 public:
  SignsAround(const SurfaceCells& cells, std::size_t block) {
    for (std::size_t side = 0; side < 8; ++side) {
      const std::int32_t n = cells.above[block][side];
      if (n != kNoBlock) {
        masks_[side] = &cells.inside[static_cast<std::size_t>(n)];
      } else {
        // A missing block is on the side of the voxels that it would touch.
        const std::size_t x = side % 2 == 1 ? 7 : 0;
        const std::size_t bit = (side / 2 % 2 == 1 ? 56 : 0) + (side / 4 == 1 ? 7 : 0);
        const bool is_inside = (cells.inside[block][x] >> bit & 1) != 0;
        masks_[side] = is_inside ? &kAllVoxels : &kNoVoxels;
      }
    }
  }

  /// Plane x of the block, 0 to 8.
  SignPlanes At(std::size_t x) const {
    const std::size_t beyond = x / 8;
    const auto word = [&](std::size_t side) { return (*masks_[side + beyond])[x % 8]; };
    const std::uint64_t at = word(0), z = word(4);
    const std::uint64_t next_y = at >> 8 | word(2) << 56, next_yz = z >> 8 | word(6) << 56;
    const auto step_z = [](std::uint64_t own, std::uint64_t above) {
      return (own >> 1 & ~kLastZ) | (above << 7 & kLastZ);
    };
    return {at, next_y, step_z(at, z), step_z(next_y, next_yz)};
  }

 private:
  std::array<const VoxelMask*, 8> masks_;
};

/// Calls visit(x, lower, upper) for the planes of corners of each of a block's eight layers.
template <typename Visit>
void ForLayers(const SurfaceCells& cells, std::size_t block, Visit&& visit) {
  const SignsAround around(cells, block);
  SignPlanes lower = around.At(0);
  for (std::size_t x = 0; x < 8; ++x) {
    const SignPlanes upper = around.At(x + 1);
    visit(x, lower, upper);
    lower = upper;
  }
}

void ConnectBlocks(const NarrowBand& band, SurfaceCells& cells) {
  const BlockMap map(band.blocks);
  cells.above.resize(band.size());
  cells.below.resize(band.size());
  cells.inside.resize(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    cells.above[b][0] = static_cast<std::int32_t>(b);
    for (int side = 1; side < 8; ++side) {
      const Eigen::Vector3i step(side & 1, side >> 1 & 1, side >> 2);
      cells.above[b][static_cast<std::size_t>(side)] = map.Find(band.blocks[b] + kBlockSide * step);
    }
    for (int axis = 0; axis < 3; ++axis) {
      cells.below[b][static_cast<std::size_t>(axis)] =
          map.Find(band.blocks[b] - kBlockSide * Eigen::Vector3i::Unit(axis));
    }
    cells.inside[b] = InsideOf(band.values.data() + kBlockVoxels * b);
  });
}

void FindCrossed(SurfaceCells& cells) {
  const std::size_t blocks = cells.inside.size();
  cells.crossed.resize(blocks);
  cells.in_layers.resize(blocks);
  cells.first.assign(blocks + 1, 0);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    std::uint32_t count = 0;
    ForLayers(cells, b, [&](std::size_t x, const SignPlanes& low, const SignPlanes& high) {
      const std::uint64_t any =
          low.at | low.y | low.z | low.yz | high.at | high.y | high.z | high.yz;
      const std::uint64_t all =
          low.at & low.y & low.z & low.yz & high.at & high.y & high.z & high.yz;
      cells.crossed[b][x] = any & ~all;
      cells.in_layers[b][x] = static_cast<std::uint16_t>(count);
      count += static_cast<std::uint32_t>(CountBits(any & ~all));
    });
    cells.first[b + 1] = count;
  });
  for (std::size_t b = 0; b < blocks; ++b) cells.first[b + 1] += cells.first[b];
}

void ReadSigns(SurfaceCells& cells) {
  cells.signs.resize(cells.first.back());
  tbb::parallel_for(std::size_t{0}, cells.inside.size(), [&](std::size_t b) {
    std::size_t number = cells.first[b];
    ForLayers(cells, b, [&](std::size_t x, const SignPlanes& low, const SignPlanes& high) {
      for (std::uint64_t word = cells.crossed[b][x]; word != 0; word &= word - 1) {
        const int i = std::countr_zero(word);
        const auto bit = [i](std::uint64_t plane, int corner) {
          return (plane >> i & 1) << corner;
        };
        cells.signs[number++] = static_cast<CellSigns>(
            bit(low.at, 0) | bit(high.at, 1) | bit(low.y, 2) | bit(high.y, 3) | bit(low.z, 4) |
            bit(high.z, 5) | bit(low.yz, 6) | bit(high.yz, 7));
      }
    });
  });
}

/// The crossed cell beyond a face of another, if its block is there.
std::int64_t NumberBeyond(const SurfaceCells& cells, std::size_t block, std::size_t cell,
                          int face) {
  constexpr std::array<std::size_t, 3> kStride = {64, 8, 1};
  const auto axis = static_cast<std::size_t>(face / 2);
  const std::size_t stride = kStride[axis], place = cell / stride % 8;
  std::int32_t in = static_cast<std::int32_t>(block);
  if (face % 2 == 0) {
    if (place == 0) in = cells.below[block][axis];
    cell = place == 0 ? cell + 7 * stride : cell - stride;
  } else {
    if (place == 7) in = cells.above[block][std::size_t{1} << axis];
    cell = place == 7 ? cell - 7 * stride : cell + stride;
  }
  if (in == kNoBlock) return -1;
  const auto there = static_cast<std::size_t>(in);
  const bool is_crossed = (cells.crossed[there][cell / 64] >> cell % 64 & 1) != 0;
  return is_crossed ? static_cast<std::int64_t>(cells.Number(there, cell)) : -1;
}

void PartPieces(SurfaceCells& cells) {
  cells.apart.assign(cells.signs.size(), 0);
  tbb::parallel_for(std::size_t{0}, cells.inside.size(), [&](std::size_t b) {
    cells.ForCells(b, [&](std::size_t cell, std::size_t number) {
      const std::uint8_t face = PiecesJoined(cells.signs[number]).twice;
      if (face == kNoFace) return;
      const std::int64_t other = NumberBeyond(cells, b, cell, face);
      if (other < 0) return;
      const std::uint8_t back = PiecesJoined(cells.signs[static_cast<std::size_t>(other)]).twice;
      if (back == (face ^ 1)) cells.apart[number] = 1;
    });
  });
}

}  // namespace

SurfaceCells FindSurfaceCells(const NarrowBand& band) {
  SurfaceCells cells;
  ConnectBlocks(band, cells);
  FindCrossed(cells);
  ReadSigns(cells);
  PartPieces(cells);
  return cells;
}

}  // namespace lascaux

#include "volume/surface_cells.h"

#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <optional>
#include <utility>

#include "volume/sign_planes.h"

namespace lascaux {
namespace {

/// Bit i is set where values[i] is below 0.
std::uint64_t BelowZero(const float* values) {
  std::uint64_t word = 0;
#if defined(__SSE2__)
  const auto four = [values](std::size_t i) {
    return _mm_castps_si128(_mm_cmplt_ps(_mm_loadu_ps(values + i), _mm_setzero_ps()));
  };
  for (std::size_t i = 0; i < 64; i += 16) {
    const __m128i low = _mm_packs_epi32(four(i), four(i + 4));
    const __m128i high = _mm_packs_epi32(four(i + 8), four(i + 12));
    const auto bits = static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(low, high)));
    word |= std::uint64_t{bits} << i;
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

void ConnectBlocks(const NarrowBand& band, const BlockMap& map, SurfaceCells& cells) {
  cells.above.resize(band.size());
  cells.inside.resize(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    cells.above[b][0] = static_cast<std::int32_t>(b);
    for (int side = 1; side < 8; ++side) {
      const Eigen::Vector3i step(side & 1, side >> 1 & 1, side >> 2);
      cells.above[b][static_cast<std::size_t>(side)] = map.Find(band.blocks[b] + kBlockSide * step);
    }
    cells.inside[b] = InsideOf(band.values.data() + kBlockVoxels * b);
  });
}

/// Each number of a block becomes the sum of those before.
void AddUp(std::vector<std::uint32_t>& numbers) {
  std::uint32_t sum = 0;
  for (std::uint32_t& number : numbers) sum += std::exchange(number, sum);
}

void FindCrossed(SurfaceCells& cells) {
  cells.crossed.resize(cells.size());
  cells.in_layers.resize(cells.size());
  cells.first.assign(cells.size() + 1, 0);
  cells.first_quad.assign(cells.size() + 1, 0);
  tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t b) {
    std::size_t count = 0, quads = 0;
    ForLayers(cells, b, [&](std::size_t x, const SignPlanes& low, const SignPlanes& high) {
      const std::uint64_t any =
          low.at | low.y | low.z | low.yz | high.at | high.y | high.z | high.yz;
      const std::uint64_t all =
          low.at & low.y & low.z & low.yz & high.at & high.y & high.z & high.yz;
      cells.crossed[b][x] = any & ~all;
      cells.in_layers[b][x] = static_cast<std::uint16_t>(count);
      if ((any & ~all) == 0) return;
      count += CountBits(any & ~all);
      for (const UpperEdges& edges : UpperEdgesOf(low, high)) quads += CountBits(edges.crossed);
    });
    cells.first[b] = static_cast<std::uint32_t>(count);
    cells.first_quad[b] = static_cast<std::uint32_t>(quads);
  });
  AddUp(cells.first);
  AddUp(cells.first_quad);
}

/// A cell with a face that one piece crosses twice.
struct TwiceCrossed {
  std::uint32_t number;
  std::size_t block, cell;
};

/// Reads the signs and counts the vertices of joined pieces; returns cells in any order.
std::vector<TwiceCrossed> ReadSigns(SurfaceCells& cells) {
  cells.signs.resize(cells.first.back());
  cells.first_vertex.assign(cells.size() + 1, 0);
  tbb::combinable<std::vector<TwiceCrossed>> twice;
  tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t b) {
    if (cells.IsEmpty(b)) return;
    std::uint32_t number = cells.first[b], vertices = 0;
    ForLayers(cells, b, [&](std::size_t x, const SignPlanes& low, const SignPlanes& high) {
      for (std::uint64_t word = cells.crossed[b][x]; word != 0; word &= word - 1) {
        const int i = std::countr_zero(word);
        const auto bit = [i](std::uint64_t plane, int corner) {
          return (plane >> i & 1) << corner;
        };
        const auto signs = static_cast<CellSigns>(bit(low.at, 0) | bit(high.at, 1) | bit(low.y, 2) |
                                                  bit(high.y, 3) | bit(low.z, 4) | bit(high.z, 5) |
                                                  bit(low.yz, 6) | bit(high.yz, 7));
        const CellPieces& pieces = PiecesJoined(signs);
        vertices += pieces.count;
        if (pieces.twice != kNoFace)
          twice.local().push_back({number, b, 64 * x + static_cast<std::size_t>(i)});
        cells.signs[number++] = signs;
      }
    });
    cells.first_vertex[b] = vertices;
  });
  std::vector<TwiceCrossed> all;
  twice.combine_each([&](const std::vector<TwiceCrossed>& some) {
    all.insert(all.end(), some.begin(), some.end());
  });
  return all;
}

/// The crossed cell beyond a face of another, if its block is there.
std::optional<std::size_t> NumberBeyond(const SurfaceCells& cells, const BlockMap& map,
                                        const Eigen::Vector3i& in, const TwiceCrossed& from) {
  const int face = PiecesJoined(cells.signs[from.number]).twice;
  constexpr std::array<std::size_t, 3> kStride = {64, 8, 1};
  const std::size_t stride = kStride[static_cast<std::size_t>(face / 2)];
  const std::size_t place = from.cell / stride % 8;
  const int step = face % 2 == 0 ? -1 : 1;
  const bool leaves = place == (step < 0 ? 0 : 7);
  std::size_t cell = from.cell + static_cast<std::size_t>(step) * stride;
  if (leaves) cell -= static_cast<std::size_t>(step) * 8 * stride;
  std::size_t block = from.block;
  if (leaves) {
    const std::int32_t found = map.Find(in + step * kBlockSide * Eigen::Vector3i::Unit(face / 2));
    if (found == kNoBlock) return std::nullopt;
    block = static_cast<std::size_t>(found);
  }
  if ((cells.crossed[block][cell / 64] >> cell % 64 & 1) == 0) return std::nullopt;
  return cells.Number(block, cell);
}

void PartPieces(const NarrowBand& band, const BlockMap& map, const std::vector<TwiceCrossed>& twice,
                SurfaceCells& cells) {
  for (const TwiceCrossed& one : twice) {
    const auto other = NumberBeyond(cells, map, band.blocks[one.block], one);
    if (!other) continue;
    const int face = PiecesJoined(cells.signs[one.number]).twice;
    if (PiecesJoined(cells.signs[*other]).twice != (face ^ 1)) continue;
    cells.apart.push_back(one.number);
    ++cells.first_vertex[one.block];  // one piece more
  }
  std::sort(cells.apart.begin(), cells.apart.end());
}

}  // namespace

SurfaceCells FindSurfaceCells(const NarrowBand& band) {
  SurfaceCells cells;
  const BlockMap map(band.blocks);
  ConnectBlocks(band, map, cells);
  FindCrossed(cells);
  PartPieces(band, map, ReadSigns(cells), cells);
  AddUp(cells.first_vertex);
  return cells;
}

}  // namespace lascaux

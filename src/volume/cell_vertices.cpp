#include "volume/cell_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "volume/block_frame.h"
#include "volume/finish_band.h"
#include "volume/four.h"

namespace lascaux {
namespace {

using Eigen::Vector3f;

constexpr std::size_t CornerOf(std::size_t axis, std::size_t along, std::size_t u, std::size_t w) {
  return along << axis | u << (axis + 1) % 3 | w << (axis + 2) % 3;
}

/// The distances at the corners of four cells, without sign, in the order of CellSigns.
using CellCorners = std::array<Four, 8>;

LASCAUX_INLINE Four AtLeast(float least, Four a) { return a < least ? Four{} + least : a; }

/// What a cell's crossings along an axis add to the mean: the sum of their places there, and how
/// many there are of those with u = 1, w = 1 and of all.
struct Along {
  Four sum;
  FourInts beyond_u, beyond_w, count;
};

template <std::size_t kAxis>
LASCAUX_INLINE Along CrossingsAlong(const CellCorners& corners, const FourInts& signs) {
  const FourInts changes =
      signs ^ (signs >> (1 << kAxis));  // bit of the corner that an edge starts at
  std::array<Four, 4> crossings;
  std::array<FourInts, 4> is_crossed;
  for (std::size_t place = 0; place < 4; ++place) {
    const std::size_t start = CornerOf(kAxis, 0, place & 1, place >> 1);
    const Four from = corners[start], crossing = from / (from + corners[start | 1U << kAxis]);
    const auto bit = static_cast<std::int32_t>(1U << start);
    is_crossed[place] = (changes & bit) == bit;
    crossings[place] = Where(is_crossed[place], crossing);
  }
  const FourInts beyond_u = is_crossed[1] + is_crossed[3];
  return {(crossings[0] + crossings[1]) + (crossings[2] + crossings[3]), -beyond_u,
          -(is_crossed[2] + is_crossed[3]), -(beyond_u + is_crossed[0] + is_crossed[2])};
}

/// Means of the crossings of four cells.
LASCAUX_INLINE FourPoints MeansOf(const CellCorners& corners, const FourInts& signs) {
  const Along x = CrossingsAlong<0>(corners, signs), y = CrossingsAlong<1>(corners, signs),
              z = CrossingsAlong<2>(corners, signs);
  const Four count = __builtin_convertvector(x.count + y.count + z.count, Four);
  // Along y, u is z and w is x.
  return {(x.sum + __builtin_convertvector(y.beyond_w + z.beyond_u, Four)) / count,
          (y.sum + __builtin_convertvector(x.beyond_u + z.beyond_w, Four)) / count,
          (z.sum + __builtin_convertvector(x.beyond_w + y.beyond_u, Four)) / count};
}

}  // namespace

CellVertices::CellVertices(const NarrowBand& band, const SurfaceCells& cells, std::size_t block,
                           const BlockValues& missing)
    : least_(kLeastDistance * static_cast<float>(band.voxel_size)) {
  std::array<const float*, 8> values;
  for (std::size_t side = 0; side < 8; ++side) {
    const std::int32_t found = cells.above[block][side];
    values[side] = found == kNoBlock
                       ? missing.data()
                       : band.values.data() + kBlockVoxels * static_cast<std::size_t>(found);
  }
  const VoxelMask& crossed = cells.crossed[block];
  for (std::size_t x = 0; x <= 8; ++x) {
    if ((x < 8 ? crossed[x] : 0) == 0 && (x > 0 ? crossed[x - 1] : 0) == 0) continue;
    const std::size_t beyond = x / 8, voxel = 64 * (x % 8);
    float* line = values_.data() + kStride[0] * x;
    const auto copy = [&](const float* from, const float* behind) {
      std::memcpy(line, from, 8 * sizeof(float));
      line[8] = *behind;
      line += kStride[1];
    };
    for (std::size_t y = 0; y < 8; ++y)
      copy(values[beyond] + voxel + 8 * y, values[beyond | 4] + voxel + 8 * y);
    copy(values[beyond | 2] + voxel, values[beyond | 6] + voxel);
  }
}

void CellVertices::PlaceMeans(std::span<const std::uint16_t> cells, const CellSigns* signs,
                              Vector3f* to) const {
  for (std::size_t at = 0; at < cells.size(); at += 4) {
    FourInts cell{}, sign{};
    std::array<float*, 4> places;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t k = std::min(at + i, cells.size() - 1);
      cell[i] = cells[k];
      sign[i] = signs[k];
      places[i] = to[k].data();
    }
    const FourCells in_block(cell);
    const FourInts place = 81 * in_block.x + 9 * in_block.y + in_block.z;
    CellCorners corners;
    for (std::size_t xy = 0; xy < 4; ++xy) {
      const float* const from = values_.data() + kStride[0] * (xy & 1) + kStride[1] * (xy >> 1);
      const Four a = TwoAndTwo(from + place[0], from + place[1]);
      const Four b = TwoAndTwo(from + place[2], from + place[3]);
      corners[xy] = AtLeast(least_, Size(__builtin_shufflevector(a, b, 0, 2, 4, 6)));
      corners[xy + 4] = AtLeast(least_, Size(__builtin_shufflevector(a, b, 1, 3, 5, 7)));
    }
    Scatter(MeansOf(corners, sign), places);
  }
}

std::array<Vector3f, 4> CellVertices::In(std::size_t cell, const CellPieces& pieces) const {
  const float* const from =
      values_.data() + kStride[0] * (cell / 64) + kStride[1] * (cell / 8 % 8) + cell % 8;
  const auto distance = [&](std::size_t corner) {
    const float value =
        from[kStride[0] * (corner & 1) + kStride[1] * (corner >> 1 & 1) + (corner >> 2)];
    return std::max(std::abs(value), least_);
  };
  std::array<Vector3f, 4> means;
  std::array<float, 4> count{};
  for (std::size_t p = 0; p < pieces.count; ++p) means[p].setZero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t place = 0; place < 4; ++place) {
      const std::size_t u = place & 1, w = place >> 1;
      const std::uint8_t piece = pieces.of_edge[4 * axis + place];
      if (piece == kNotCrossed) continue;
      const float start = distance(CornerOf(axis, 0, u, w)),
                  end = distance(CornerOf(axis, 1, u, w));
      const auto along = static_cast<int>(axis);
      means[piece][along] += start / (start + end);
      means[piece][(along + 1) % 3] += static_cast<float>(u);
      means[piece][(along + 2) % 3] += static_cast<float>(w);
      count[piece] += 1;
    }
  }
  for (std::size_t p = 0; p < pieces.count; ++p) means[p] /= count[p];
  return means;
}

void PlaceInModel(const NarrowBand& band, std::size_t block, std::span<const std::uint16_t> cells,
                  Vector3f* vertices) {
  const BlockFrame frame(band, block);
  for (std::size_t at = 0; at < cells.size(); at += 4) {
    FourInts cell{};
    std::array<float*, 4> places;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t k = std::min(at + i, cells.size() - 1);
      cell[i] = cells[k];
      places[i] = vertices[k].data();
    }
    Scatter(frame.InModel(FourCells(cell), Gather(places)), places);
  }
}

}  // namespace lascaux

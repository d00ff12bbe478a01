#include "volume/cell_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "volume/finish_band.h"

namespace lascaux {
namespace {

using Eigen::Vector3f;

/// An edge's four places across an axis, in the notation that g++ and clang share.
using Four [[gnu::vector_size(16)]] = float;

/// What is known of a cell with one piece from its corners' signs.
struct OnePiece {
  std::array<Four, 3> crossed{};  ///< 1 where an edge is, 0 elsewhere, for each axis
  Four places{};                  ///< sum of the places across of all edges that are crossed
  float count = 1;                ///< of them
};

constexpr std::array<OnePiece, 256> MakeOnePieces() {
  std::array<OnePiece, 256> table;
  for (int signs = 0; signs < 256; ++signs) {
    OnePiece& piece = table[static_cast<std::size_t>(signs)];
    int count = 0;
    std::array<int, 3> sum{};
    for (int axis = 0; axis < 3; ++axis) {
      std::array<float, 4> crossed{};
      const int along_u = (axis + 1) % 3, along_w = (axis + 2) % 3;
      for (int place = 0; place < 4; ++place) {
        const int u = place & 1, w = place >> 1, start = u << along_u | w << along_w;
        if (((signs >> start ^ signs >> (start | 1 << axis)) & 1) == 0) continue;
        crossed[static_cast<std::size_t>(place)] = 1;
        sum[static_cast<std::size_t>(along_u)] += u;
        sum[static_cast<std::size_t>(along_w)] += w;
        ++count;
      }
      piece.crossed[static_cast<std::size_t>(axis)] =
          Four{crossed[0], crossed[1], crossed[2], crossed[3]};
    }
    piece.places =
        Four{static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]), 0};
    piece.count = static_cast<float>(std::max(count, 1));
  }
  return table;
}

const std::array<OnePiece, 256> kOnePieces = MakeOnePieces();

/// Distances at a cell's corners with z = 0 and 1, in the order (x, y) = 00, 10, 01, 11.
struct CellCorners {
  Four low, high;

  /// At the starts and the ends of the edges along an axis, in the order of CellEdge.
  Four Starts(std::size_t axis) const {
    if (axis == 0) return __builtin_shufflevector(low, high, 0, 2, 4, 6);
    return axis == 1 ? __builtin_shufflevector(low, high, 0, 4, 1, 5) : low;
  }
  Four Ends(std::size_t axis) const {
    if (axis == 0) return __builtin_shufflevector(low, high, 1, 3, 5, 7);
    return axis == 1 ? __builtin_shufflevector(low, high, 2, 6, 3, 7) : high;
  }
};

}  // namespace

CellVertices::CellVertices(const NarrowBand& band, const BlocksAbove& above)
    : least_(kLeastDistance * static_cast<float>(band.voxel_size)) {
  for (std::size_t side = 0; side < 8; ++side) {
    if (above[side] == kNoBlock) missing_.fill(band.background);
    values_[side] = above[side] == kNoBlock
                        ? missing_.data()
                        : band.values.data() + kBlockVoxels * static_cast<std::size_t>(above[side]);
  }
}

std::array<CellVertices::Four, 3> CellVertices::CrossingsOf(std::size_t cell) const {
  const auto step = [cell](std::size_t stride) -> std::size_t {
    return cell / stride % 8 == 7 ? std::size_t{0} - 7 * stride : stride;
  };
  const std::size_t x = step(64), y = step(8), z = step(1);
  const std::size_t beyond_x = x == 64 ? 0 : 1, beyond_y = y == 8 ? 0 : 2,
                    beyond_z = z == 1 ? 0 : 4;
  const auto at = [&](std::size_t side, std::size_t voxel) { return values_[side][voxel]; };
  const auto layer = [&](std::size_t side, std::size_t voxel) {
    const Four values = {at(side, voxel), at(side + beyond_x, voxel + x),
                         at(side + beyond_y, voxel + y),
                         at(side + beyond_x + beyond_y, voxel + x + y)};
    const Four sizes = values < 0 ? -values : values;
    return sizes < least_ ? Four{} + least_ : sizes;
  };
  const CellCorners corners{layer(0, cell), layer(beyond_z, cell + z)};
  std::array<Four, 3> crossings;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The two are on different sides.
    const Four start = corners.Starts(axis);
    crossings[axis] = start / (start + corners.Ends(axis));
  }
  return crossings;
}

Vector3f CellVertices::InOnePiece(std::size_t cell, CellSigns signs) const {
  const std::array<Four, 3> crossings = CrossingsOf(cell);
  const OnePiece& one = kOnePieces[signs];
  Vector3f mean;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Four sums = crossings[axis] * one.crossed[axis];
    mean[static_cast<int>(axis)] =
        ((sums[0] + sums[1]) + (sums[2] + sums[3]) + one.places[axis]) / one.count;
  }
  return mean;
}

std::array<Vector3f, 4> CellVertices::In(std::size_t cell, const CellPieces& pieces) const {
  const std::array<Four, 3> crossings = CrossingsOf(cell);
  std::array<Vector3f, 4> means;
  std::array<float, 4> count{};
  for (std::size_t p = 0; p < pieces.count; ++p) means[p].setZero();
  for (int axis = 0; axis < 3; ++axis) {
    for (int place = 0; place < 4; ++place) {
      const int u = place & 1, w = place >> 1;
      const std::uint8_t piece = pieces.of_edge[CellEdge(axis, u, w)];
      if (piece == kNotCrossed) continue;
      means[piece][axis] += crossings[static_cast<std::size_t>(axis)][place];
      means[piece][(axis + 1) % 3] += static_cast<float>(u);
      means[piece][(axis + 2) % 3] += static_cast<float>(w);
      count[piece] += 1;
    }
  }
  for (std::size_t p = 0; p < pieces.count; ++p) means[p] /= count[p];
  return means;
}

}  // namespace lascaux

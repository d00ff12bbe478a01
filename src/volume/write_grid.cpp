#include "volume/write_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>

#include "lascaux/volume/level_set.h"

namespace lascaux {
namespace {

using openvdb::Coord;
using Leaf = openvdb::FloatTree::LeafNodeType;

/// Signed distances of a leaf's voxels, with those in the band.
struct LeafValues {
  std::array<float, kBlockVoxels> value;
  VoxelMask active{};
  bool has_band = false;

  void Set(std::size_t i, float distance, bool is_inside, const std::array<float, 2>& unit) {
    const auto [voxel, background] = unit;
    float magnitude = background;
    // Rounding must not take an active value to the background, or it would not be in the band.
    const float scaled = std::max(distance, kLeastDistance) * voxel;
    if (distance < static_cast<float>(kBandVoxels) && scaled < background) {
      magnitude = scaled;
      active[i / 64] |= std::uint64_t{1} << i % 64;
      has_band = true;
    }
    value[i] = is_inside ? -magnitude : magnitude;
  }
};

/// A leaf or, where no voxel is in the band, on which side it is.
struct Piece {
  Coord origin;
  std::unique_ptr<Leaf> leaf;
  bool is_inside = false;
};

class Writer {
 public:
  Writer(const Band& band, double voxel_size)
      : band_(band), unit_{static_cast<float>(voxel_size), BandBackground(voxel_size)} {}

  Piece Upper(std::size_t b) const {
    LeafValues values;
    for (std::size_t i = 0; i < kBlockVoxels; ++i) Copy(b, i, values, i);
    return MakePiece(band_.origins[b], values);
  }

  /// The leaf at -8 - z of a block at z: its own voxels but those at its lowest z, and those at the
  /// lowest z of the block above. One of the two may be missing.
  Piece Lower(const Coord& origin, std::int32_t block, std::int32_t above) const {
    LeafValues values;
    for (std::size_t line = 0; line < kBlockVoxels; line += 8) {
      for (std::size_t k = 0; k < 8; ++k) {
        // Voxel k of the line is at -8 - z + k, the image of 8 - k above the block's lowest.
        const std::int32_t from = k == 0 ? above : block;
        const std::size_t at = line + (k == 0 ? 0 : 8 - k);
        if (from != kNoBlock) {
          Copy(static_cast<std::size_t>(from), at, values, line + k);
        } else {
          // Far from the surface, so on the same side as the voxel that touches it.
          const bool is_inside = k == 0 ? IsInside(block, line + 7) : IsInside(above, line);
          values.Set(line + k, kFar, is_inside, unit_);
        }
      }
    }
    return MakePiece(Coord(origin.x(), origin.y(), -kBlockSide - origin.z()), values);
  }

 private:
  bool IsInside(std::int32_t block, std::size_t i) const {
    return (band_.inside[static_cast<std::size_t>(block)][i / 64] >> i % 64 & 1) != 0;
  }

  void Copy(std::size_t block, std::size_t i, LeafValues& values, std::size_t to) const {
    values.Set(to, band_.distance[kBlockVoxels * block + i],
               IsInside(static_cast<std::int32_t>(block), i), unit_);
  }

  Piece MakePiece(const Coord& origin, const LeafValues& values) const {
    Piece piece{origin, nullptr, values.value[0] < 0};
    if (!values.has_band) return piece;
    piece.leaf = std::make_unique<Leaf>(origin, unit_[1]);
    std::copy(values.value.begin(), values.value.end(), piece.leaf->buffer().data());
    Leaf::NodeMaskType mask;
    for (openvdb::Index n = 0; n < 8; ++n) mask.getWord<std::uint64_t>(n) = values.active[n];
    piece.leaf->setValueMask(mask);
    return piece;
  }

  const Band& band_;
  std::array<float, 2> unit_;  // of a voxel, and the background
};

/// Blocks whose mirror images make a leaf: the one at its z, and the one above that.
struct LowerLeaf {
  Coord origin;
  std::int32_t block, above;
};

std::vector<LowerLeaf> ListLowerLeaves(const Band& band) {
  std::vector<LowerLeaf> list;
  for (std::size_t b = 0; b < band.size(); ++b) {
    const auto index = static_cast<std::int32_t>(b);
    list.push_back({band.origins[b], index, band.neighbours[b][5]});
    if (band.origins[b].z() > 0 && band.neighbours[b][4] == kNoBlock) {
      list.push_back({band.origins[b].offsetBy(0, 0, -kBlockSide), kNoBlock, index});
    }
  }
  return list;
}

void AddTile(openvdb::FloatTree& tree, const Coord& origin) {
  constexpr openvdb::Index kLeafLevel = 1;  // a tile of a leaf's size
  tree.addTile(kLeafLevel, origin, -tree.background(), false);
}

void AddTiles(openvdb::FloatTree& tree, const Cube& cube, bool mirror) {
  for (int x = 0; x < cube.side; x += kBlockSide) {
    for (int y = 0; y < cube.side; y += kBlockSide) {
      for (int z = 0; z < cube.side; z += kBlockSide) {
        const Coord origin = cube.origin.offsetBy(x, y, z);
        AddTile(tree, origin);
        if (mirror) AddTile(tree, Coord(origin.x(), origin.y(), -kBlockSide - origin.z()));
      }
    }
  }
}

}  // namespace

float BandBackground(double voxel_size) {
  const double least = kBandVoxels * voxel_size;
  auto background = static_cast<float>(least);
  while (static_cast<double>(background) < least) {
    background = std::nextafter(background, std::numeric_limits<float>::infinity());
  }
  return background;
}

openvdb::FloatGrid::Ptr WriteGrid(const Band& band, const std::vector<Cube>& inside,
                                  double voxel_size) {
  auto grid = openvdb::FloatGrid::create(BandBackground(voxel_size));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel_size));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface");

  const Writer writer(band, voxel_size);
  const std::vector<LowerLeaf> lower =
      band.upper_half ? ListLowerLeaves(band) : std::vector<LowerLeaf>();
  std::vector<Piece> pieces(band.size() + lower.size());
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
    if (i < band.size()) {
      pieces[i] = writer.Upper(i);
    } else {
      const LowerLeaf& leaf = lower[i - band.size()];
      pieces[i] = writer.Lower(leaf.origin, leaf.block, leaf.above);
    }
  });
  // Tiles first: the image of a cube is one voxel off the leaves, and where a leaf is needed it
  // wins.
  openvdb::FloatTree& tree = grid->tree();
  for (const Cube& cube : inside) AddTiles(tree, cube, band.upper_half);
  for (Piece& piece : pieces) {
    if (piece.leaf != nullptr) {
      tree.addLeaf(piece.leaf.release());
    } else if (piece.is_inside) {
      AddTile(tree, piece.origin);
    }
  }
  return grid;
}

}  // namespace lascaux

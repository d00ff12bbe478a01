#include "lascaux/volume/level_set.h"

#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "lascaux/base/arena.h"
#include "lascaux/volume/extract_mesh.h"

namespace lascaux {
namespace {

using openvdb::Coord;
using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;

Coord ToCoord(const Eigen::Vector3i& voxel) { return {voxel.x(), voxel.y(), voxel.z()}; }

std::unique_ptr<Leaf> MakeLeaf(const NarrowBand& band, std::size_t block) {
  auto leaf = std::make_unique<Leaf>(ToCoord(band.blocks[block]), band.background);
  std::copy_n(band.values.data() + kBlockVoxels * block, kBlockVoxels, leaf->buffer().data());
  Leaf::NodeMaskType mask;
  for (openvdb::Index n = 0; n < 8; ++n) mask.getWord<std::uint64_t>(n) = band.active[block][n];
  leaf->setValueMask(mask);
  return leaf;
}

void AddTiles(Tree& tree, const Cube& cube) {
  constexpr openvdb::Index kLeafLevel = 1;  // a tile of a leaf's size
  for (int x = 0; x < cube.side; x += kBlockSide) {
    for (int y = 0; y < cube.side; y += kBlockSide) {
      for (int z = 0; z < cube.side; z += kBlockSide) {
        tree.addTile(kLeafLevel, ToCoord(cube.origin).offsetBy(x, y, z), -tree.background(), false);
      }
    }
  }
}

/// Does the block beyond `step` touch a voxel of the leaf that is not on its side?
bool TouchesOtherSide(const Leaf& leaf, const Coord& step, bool is_inside) {
  const auto range = [](int s) {
    return s < 0 ? std::pair(0, 1) : s > 0 ? std::pair(7, 8) : std::pair(0, 8);
  };
  const auto [x0, x1] = range(step.x());
  const auto [y0, y1] = range(step.y());
  const auto [z0, z1] = range(step.z());
  for (int x = x0; x < x1; ++x) {
    for (int y = y0; y < y1; ++y) {
      for (int z = z0; z < z1; ++z) {
        if ((leaf.getValue(static_cast<openvdb::Index>(64 * x + 8 * y + z)) < 0) != is_inside)
          return true;
      }
    }
  }
  return false;
}

/// Tiles beside leaves with another sign, as blocks: where they are, and their value.
std::map<Coord, float> TilesAtSurface(const Tree& tree) {
  std::map<Coord, float> found;
  const openvdb::tree::ValueAccessor<const Tree> values(tree);
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    for (int side = 0; side < 27; ++side) {
      const Coord step(side / 9 - 1, side / 3 % 3 - 1, side % 3 - 1);
      const Coord origin = leaf->origin().offsetBy(kBlockSide * step.x(), kBlockSide * step.y(),
                                                   kBlockSide * step.z());
      if (values.probeConstLeaf(origin) != nullptr) continue;
      const float value = values.getValue(origin);
      if (TouchesOtherSide(*leaf, step, value < 0)) found.emplace(origin, value);
    }
  }
  return found;
}

}  // namespace

openvdb::FloatGrid::Ptr ToLevelSet(const NarrowBand& band, const Execution& execution) {
  auto grid = openvdb::FloatGrid::create(band.background);
  const auto transform = openvdb::math::Transform::createLinearTransform(band.voxel_size);
  transform->postTranslate({band.origin.x(), band.origin.y(), band.origin.z()});
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface");

  std::vector<std::unique_ptr<Leaf>> leaves(band.size());
  RunInArena(execution, [&] {
    tbb::parallel_for(std::size_t{0}, band.size(),
                      [&](std::size_t b) { leaves[b] = MakeLeaf(band, b); });
  });
  // Tiles first: the image of a cube is one voxel off the leaves, and where a leaf is needed it
  // wins.
  Tree& tree = grid->tree();
  for (const Cube& cube : band.inside) AddTiles(tree, cube);
  for (std::unique_ptr<Leaf>& leaf : leaves) tree.addLeaf(leaf.release());
  return grid;
}

NarrowBand ToNarrowBand(const openvdb::FloatGrid& grid, const Execution& execution) {
  NarrowBand band;
  band.voxel_size = grid.voxelSize().x();
  const openvdb::Vec3d origin = grid.indexToWorld(openvdb::Vec3d(0, 0, 0));
  band.origin = {origin.x(), origin.y(), origin.z()};
  band.background = grid.background();
  std::vector<const Leaf*> leaves;
  grid.tree().getNodes(leaves);
  const std::map<Coord, float> tiles = TilesAtSurface(grid.tree());
  const auto add = [&band](const Coord& at) { band.blocks.emplace_back(at.x(), at.y(), at.z()); };
  for (const Leaf* const leaf : leaves) add(leaf->origin());
  for (const auto& [at, value] : tiles) add(at);
  band.values.reserve(kBlockVoxels * band.size());
  band.values.resize(kBlockVoxels * leaves.size());
  for (const auto& [at, value] : tiles) band.values.insert(band.values.end(), kBlockVoxels, value);
  band.active.resize(band.size());
  RunInArena(execution, [&] {
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t b) {
      std::copy_n(leaves[b]->buffer().data(), kBlockVoxels, band.values.data() + kBlockVoxels * b);
      for (openvdb::Index n = 0; n < 8; ++n)
        band.active[b][n] = leaves[b]->valueMask().getWord<std::uint64_t>(n);
    });
  });
  for (auto tile = grid.cbeginValueOff(); tile; ++tile) {
    if (tile.isVoxelValue() || !(*tile < 0)) continue;
    const openvdb::CoordBBox box = tile.getBoundingBox();
    band.inside.push_back({{box.min().x(), box.min().y(), box.min().z()}, box.dim().x()});
  }
  return band;
}

Outcome<openvdb::FloatGrid::Ptr> Rasterise(const Field& field, const RasteriseOptions& options,
                                           const Execution& execution) {
  Diagnostics found;
  const auto band = RasteriseBand(field, options, execution).MoveInto(found);
  if (!band) return Outcome<openvdb::FloatGrid::Ptr>::Failure(std::move(found));
  return {ToLevelSet(*band, execution), std::move(found)};
}

Outcome<Mesh> ExtractMesh(const openvdb::FloatGrid& grid, const Execution& execution) {
  return ExtractMesh(ToNarrowBand(grid, execution), execution);
}

}  // namespace lascaux

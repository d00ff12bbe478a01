#include "volume/render/grid_leaves.h"

namespace lascaux {
namespace {

using Eigen::Vector3i;

Vector3i ToVector(const openvdb::Coord& c) { return {c.x(), c.y(), c.z()}; }

}  // namespace

LeafTable LeavesOf(const openvdb::FloatGrid& grid) {
  static_assert(openvdb::FloatTree::LeafNodeType::DIM == kBlockSide);
  openvdb::CoordBBox box;
  grid.tree().evalLeafBoundingBox(box);
  const auto background = static_cast<float>(grid.background());
  if (box.empty()) return {Vector3i::Zero(), Vector3i::Zero(), background};
  const openvdb::Coord first(box.min() >> 3), last(box.max() >> 3);
  LeafTable table(ToVector(first), ToVector(last), background);
  table.voxel_size = static_cast<float>(grid.voxelSize().x());
  const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
  table.active_low = ToVector(active.min());
  table.active_high = ToVector(active.max());
  const auto accessor = grid.getConstAccessor();
  auto slot = table.leaves.begin();
  for (int x = first.x(); x <= last.x(); ++x) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int z = first.z(); z <= last.z(); ++z, ++slot) {
        const openvdb::Coord place(x * kBlockSide, y * kBlockSide, z * kBlockSide);
        const auto* leaf = accessor.probeConstLeaf(place);
        *slot = leaf != nullptr ? leaf->buffer().data()
                                : (*table.constant)[accessor.getValue(place) < 0 ? 1 : 0].data();
      }
    }
  }
  return table;
}

}  // namespace lascaux

#pragma once

#include <openvdb/openvdb.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lascaux {

/// Unites a level set with the solid whose signed distance at a place is `distance`. `box` holds
/// the solid.
template <typename Distance>
void Stamp(openvdb::FloatGrid& grid, const Eigen::AlignedBox3d& box, const Distance& distance) {
  const float background = grid.background();
  const auto voxel = [&grid](const Eigen::Vector3d& p) {
    return grid.worldToIndex(openvdb::Vec3d(p.x(), p.y(), p.z()));
  };
  const Eigen::Vector3d band = Eigen::Vector3d::Constant(static_cast<double>(background));
  const openvdb::CoordBBox voxels(openvdb::Coord::floor(voxel(box.min() - band)),
                                  openvdb::Coord::ceil(voxel(box.max() + band)));
  auto values = grid.getAccessor();
  for (auto ijk = voxels.begin(); ijk; ++ijk) {
    const openvdb::Vec3d p = grid.indexToWorld(*ijk);
    const auto d = static_cast<float>(distance(Eigen::Vector3d(p.x(), p.y(), p.z())));
    if (d >= values.getValue(*ijk)) continue;
    if (d > -background) {
      values.setValue(*ijk, d);
    } else {
      values.setValueOff(*ijk, -background);
    }
  }
}

}  // namespace lascaux

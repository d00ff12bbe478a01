#pragma once

#include <openvdb/openvdb.h>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "lascaux/volume/render.h"
#include "volume/render/light.h"

namespace lascaux {

/// What the surface is made of, place by place. Places are in the surface's index space.
class Coloring {
 public:
  /// The model must outlive it.
  Coloring(const ShownModel& model, Material material);

  /// Between voxels of different colours, or parts, the mean by their nearness: borders are as soft
  /// as the voxels are large.
  Color AlbedoAt(const Eigen::Vector3f& place) const noexcept;

  /// The part that has most of the place; -1 where no voxel says it.
  float PartAt(const Eigen::Vector3f& place) const noexcept;

 private:
  Material material_;
  const openvdb::Vec3SGrid* color_;
  const openvdb::FloatGrid* part_;
  std::vector<Color> palette_;
  Eigen::Affine3f to_color_, to_part_;  ///< index spaces
};

}  // namespace lascaux

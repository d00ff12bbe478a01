#pragma once

#include <openvdb/openvdb.h>

#include <Eigen/Geometry>
#include <vector>

#include "lascaux/volume/render_grids.h"
#include "volume/render/coloring.h"

namespace lascaux {

/// Colours and parts as grids say them.
class GridColoring final : public Coloring {
 public:
  /// The model must outlive it.
  GridColoring(const ShownModel& model, Material material);

  /// Between voxels of different colours, or parts, the mean by their nearness: borders are as soft
  /// as the voxels are large.
  Color AlbedoAt(const Eigen::Vector3f& place) const noexcept override;

  /// The part that has most of the place; -1 where no voxel says it.
  float PartAt(const Eigen::Vector3f& place) const noexcept override;

 private:
  Material material_;
  const openvdb::Vec3SGrid* color_;
  const openvdb::FloatGrid* part_;
  std::vector<Color> palette_;
  Eigen::Affine3f to_color_, to_part_;  ///< index spaces
};

}  // namespace lascaux

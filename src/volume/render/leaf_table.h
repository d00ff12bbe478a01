#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "lascaux/volume/narrow_band.h"

/// @file
/// A level set as rays find their way in it: leaves of 8 x 8 x 8 values in a table over their box.

namespace lascaux {

/// Index space: voxel (x, y, z) is around the place with these coordinates. Values are distances in
/// any unit, negative inside; value (x, y, z) of a leaf is at 64 x + 8 y + z.
struct LeafTable {
  using Leaf = std::array<float, kBlockVoxels>;

  float voxel_size = 1, background = 0;                          ///< in the values' unit
  Eigen::Vector3i active_low{0, 0, 0}, active_high{-1, -1, -1};  ///< first and last active voxel
  Eigen::Vector3i first{0, 0, 0}, size{0, 0, 0};                 ///< of the table, in leaves
  std::vector<const float*> leaves;                              ///< z runs fastest
  std::shared_ptr<const std::array<Leaf, 2>> constant;  ///< what is no leaf: outside, inside

  /// All outside.
  LeafTable(const Eigen::Vector3i& first_leaf, const Eigen::Vector3i& last_leaf, float background);

  /// Leaves are those of the band, which must outlive the table.
  explicit LeafTable(const NarrowBand& band);

  bool empty() const noexcept { return active_low.x() > active_high.x(); }

  /// Leaf `l`, counted from voxel (0, 0, 0).
  const float* At(const Eigen::Vector3i& l) const noexcept {
    const Eigen::Vector3i c = l - first;
    const bool is_in = (c.array() >= 0).all() && (c.array() < size.array()).all();
    return is_in ? leaves[Index(c)] : (*constant)[0].data();
  }

  float ValueAt(const Eigen::Vector3i& voxel) const noexcept {
    const auto down = [](int c) { return c >> 3; };
    const Eigen::Vector3i in = voxel - kBlockSide * voxel.unaryExpr(down);
    return At(voxel.unaryExpr(down))[64 * in.x() + 8 * in.y() + in.z()];
  }

  std::size_t Index(const Eigen::Vector3i& c) const noexcept {
    return (static_cast<std::size_t>(c.x()) * static_cast<std::size_t>(size.y()) +
            static_cast<std::size_t>(c.y())) *
               static_cast<std::size_t>(size.z()) +
           static_cast<std::size_t>(c.z());
  }
};

}  // namespace lascaux

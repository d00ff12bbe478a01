#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lascaux/field/compiled_field.h"

namespace lascaux {

/// Points sorted into the cells of a coarse grid, so that a field can be evaluated for those of a
/// cell together. The order depends on the points alone.
class PointCells {
 public:
  explicit PointCells(std::span<const Eigen::Vector3f> points);

  std::size_t count() const noexcept { return first_.size() - 1; }
  /// Indices of a cell's points.
  std::span<const std::uint32_t> Points(std::size_t cell) const {
    return {order_.data() + first_[cell], first_[cell + 1] - first_[cell]};
  }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> first_;
};

/// The points of a cell, moved by an offset, as the blocks' code takes them.
struct CellBlock {
  CellBlock(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> which,
            const Eigen::Vector3d& offset);

  Ball ball;  ///< holds them all
  std::array<std::vector<float>, 3> offsets;

  PointBlock Points() const { return {ball.center, offsets[0], offsets[1], offsets[2]}; }
};

}  // namespace lascaux

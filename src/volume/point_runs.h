#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lascaux/field/compiled_field.h"

namespace lascaux {

/// Points cut into runs that are close together, so that a field can be evaluated for those of a
/// run at a time. Points of a mesh or a grid come block by block; of points in no order, each is a
/// run of its own. The runs depend on the points alone.
class PointRuns {
 public:
  explicit PointRuns(std::span<const Eigen::Vector3f> points);

  std::size_t count() const noexcept { return first_.size() - 1; }
  /// The number of a run's first point; of the run behind the last one, that of points.
  std::size_t First(std::size_t run) const { return first_[run]; }

 private:
  std::vector<std::uint32_t> first_;
};

/// The points of a run, moved by an offset, as the blocks' code takes them.
struct RunBlock {
  RunBlock(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& offset);

  Ball ball;  ///< holds them all
  std::array<std::vector<float>, 3> offsets;

  PointBlock Points() const { return {ball.center, offsets[0], offsets[1], offsets[2]}; }
};

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "skeleton/ring.h"

namespace lascaux {

/// Contains() for many points: the edges of a ring in rows, so that a point is compared with those
/// of its row alone. The same answers.
///
/// Built in linear time; a point takes as long as edges are in its row, a few in most outlines.
class InsideTest {
 public:
  /// The ring must outlive it.
  explicit InsideTest(const Ring& ring);

  bool Contains(const Eigen::Vector2d& point) const;

 private:
  std::size_t RowOf(double y) const;

  const Ring& ring_;
  double low_ = 0, per_row_ = 0;      ///< rows a unit
  std::vector<std::uint32_t> first_;  ///< entry of each row, and their number
  std::vector<std::uint32_t> edges_;  ///< each by the index of its second point
};

}  // namespace lascaux

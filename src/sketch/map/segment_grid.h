#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

/// @file
/// A uniform grid over line segments, so that neighbours are found without looking at every pair.

namespace lascaux {

/// A segment of a polyline: which line, and the index of its first point.
struct SegmentRef {
  int line = 0;
  int index = 0;
  Eigen::Vector2d a, b;
};

/// Cells of a size near the segments' mean length; memory and building time linear in the segments.
class SegmentGrid {
 public:
  explicit SegmentGrid(std::vector<SegmentRef> segments);

  const std::vector<SegmentRef>& segments() const { return segments_; }

  /// Calls visit(i) for every segment i whose cells touch the box, each once, in ascending order.
  template <typename Visit>
  void ForEachIn(const Eigen::AlignedBox2d& box, Visit&& visit) const {
    for (const int i : Candidates(box)) visit(i);
  }

 private:
  std::vector<int> Candidates(const Eigen::AlignedBox2d& box) const;
  Eigen::Vector2i CellOf(const Eigen::Vector2d& p) const;

  std::vector<SegmentRef> segments_;
  Eigen::AlignedBox2d bounds_;
  double cell_ = 1;
  Eigen::Vector2i size_{1, 1};
  std::vector<std::uint32_t> starts_;
  std::vector<int> items_;
};

}  // namespace lascaux

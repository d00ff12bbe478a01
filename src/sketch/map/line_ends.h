#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "sketch/map/arrangement.h"
#include "sketch/map/segment_grid.h"

/// @file
/// The ends of open lines, and what is near them.

namespace lascaux {

/// One end of an open line.
struct LineEnd {
  int line = 0;
  bool at_back = false;
  Eigen::Vector2d position;
};

/// A place on a line near another place.
struct NearPlace {
  int line = 0;
  Eigen::Vector2d point;
  double distance = 0;
};

/// Where a line has crossed another just before its end.
struct Overshoot {
  Eigen::Vector2d point;
  double rest = 0;  ///< length of the line beyond that
};

/// Both ends of every open line, in the order of the lines.
std::vector<LineEnd> EndsOf(const std::vector<ArrangementLine>& lines);

/// The segments of all lines.
SegmentGrid GridOf(const std::vector<ArrangementLine>& lines);

/// The square around a place.
Eigen::AlignedBox2d BoxAround(const Eigen::Vector2d& place, double radius);

/// Tells an end's own neighbourhood from the rest of its line, which is another line to an end that
/// looks no farther than `reach`.
class OwnStretch {
 public:
  OwnStretch(const ArrangementLine& line, const LineEnd& end, double reach);

  bool Holds(const SegmentRef& segment) const {
    if (segment.line != line_) return false;
    return at_back_ ? segment.index + 1 > reach_ : segment.index < reach_;
  }

 private:
  int line_;
  bool at_back_;
  int reach_ = 0;  ///< index of the first point beyond the stretch
};

/// The first crossing, seen from inside, of the last snap radius of a line before its end.
std::optional<Overshoot> FindOvershoot(const ArrangementLine& line, const LineEnd& end,
                                       const SegmentGrid& grid);

/// Of each line near a place the nearest point within `radius`, in the order of the lines, without
/// segments that are skipped.
template <typename Skip>
std::vector<NearPlace> NearLines(const Eigen::Vector2d& place, double radius,
                                 const SegmentGrid& grid, Skip&& skip) {
  std::vector<NearPlace> found;
  grid.ForEachIn(BoxAround(place, radius), [&](int s) {
    const SegmentRef& other = grid.segments()[static_cast<std::size_t>(s)];
    if (skip(other)) return;
    const Eigen::Vector2d point =
        other.a + NearestParameter(other.a, other.b, place) * (other.b - other.a);
    const double distance = (point - place).norm();
    if (distance > radius) return;
    // Segments come line by line.
    if (found.empty() || found.back().line != other.line) {
      found.push_back({other.line, point, distance});
    } else if (distance < found.back().distance) {
      found.back() = {other.line, point, distance};
    }
  });
  return found;
}

/// The nearest place of any line.
template <typename Skip>
std::optional<NearPlace> NearestLine(const Eigen::Vector2d& place, double radius,
                                     const SegmentGrid& grid, Skip&& skip) {
  const std::vector<NearPlace> near = NearLines(place, radius, grid, skip);
  const auto nearest = std::min_element(
      near.begin(), near.end(),
      [](const NearPlace& a, const NearPlace& b) { return a.distance < b.distance; });
  if (nearest == near.end()) return std::nullopt;
  return *nearest;
}

}  // namespace lascaux

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "volume/measure/outline.h"

namespace lascaux {

/// Parallel lines at equal distances: line i is at first + i * step on the axis that it is
/// perpendicular to.
struct ScanLines {
  int along = 0;  ///< axis in which the lines run
  double first = 0, step = 0;
  std::size_t count = 0;

  int across() const noexcept { return 1 - along; }
  double At(std::size_t line) const noexcept { return first + step * static_cast<double>(line); }
};

/// Lines through the middles of `step` wide strips of the box, with one more before and after it.
ScanLines LinesThrough(const Eigen::AlignedBox2d& box, int along, double step);

/// A piece of a line inside a region, with the edges that it ends at.
struct Span {
  double low, high;
  std::uint32_t low_edge, high_edge;
};

/// A region cut along lines: for each line its spans, ascending and apart.
struct SpanImage {
  ScanLines lines;
  std::vector<std::vector<Span>> spans;

  double Area() const;
};

/// Cuts a region along lines. Gaps below half a step are closed: outlines that abut up to rounding
/// are not to be told apart.
SpanImage Scan(const Outline& outline, const ScanLines& lines);

/// Only the largest connected region, its holes smaller than `least_hole` (share of its area)
/// filled.
SpanImage KeepLargestRegion(const SpanImage& image, double least_hole);

/// Areas that both regions cover, and that at least one does.
struct Overlap {
  double both = 0, either = 0;
};
Overlap Compare(const SpanImage& a, const SpanImage& b);

}  // namespace lascaux

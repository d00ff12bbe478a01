#pragma once

#include <optional>
#include <vector>

#include "sketch/map/line_ends.h"

/// @file
/// Which ends of lines are meant to meet, and on which other line.

namespace lascaux {

/// Ends that meet in one place, on the way of another line or not.
struct Meeting {
  std::vector<int> ends;    ///< ascending, at least one
  std::optional<int> line;  ///< none of theirs, unless it is a single end's own far part
};

/// What is most likely is settled first: an end and another end or line, by their distance as a
/// share of how far the end's line looks (its snap radius). Ends of one meeting are no farther than
/// most of that radius from their middle, and all of them near its line; so of many ends in a row
/// not all are drawn into one. Each end is in one meeting. Time n log n in ends that lie apart.
std::vector<Meeting> FindMeetings(const std::vector<ArrangementLine>& lines,
                                  const std::vector<LineEnd>& ends, const SegmentGrid& grid);

}  // namespace lascaux

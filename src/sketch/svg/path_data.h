#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sketch/svg/cursor.h"
#include "sketch/svg/path_builder.h"

/// @file
/// The `d` attribute of a path, and the `points` of polylines and polygons.

namespace lascaux::svg {

/// All that was read before the end or the first error.
struct PathData {
  std::vector<Subpath> subpaths;
  Fault fault = Fault::kNone;
  std::size_t offset = 0;  ///< where in the text the fault is
};

/// Reads path data by SVG 1.1, section 8.3: all commands, absolute and relative, packed numbers,
/// glued arc flags.
///
/// On an error the segments before it are kept, as the standard rules. A comma too many is
/// forgiven. The project has its own parser because lib2geom's tells no offset and forgets the last
/// whole segment before an error.
PathData ParsePathData(std::string_view text, int max_pieces);

/// Whether a list of points is a polyline or a polygon.
enum class Ends : std::uint8_t { kOpen, kClosed };

/// Reads a list of points as one subpath of straight lines; an odd last number is an error, and
/// left out.
PathData ParsePoints(std::string_view text, Ends ends, int max_pieces);

}  // namespace lascaux::svg

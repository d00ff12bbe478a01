#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lascaux/sketch/bezier.h"

/// @file
/// A drawing as curves: what every reader makes, and the first value of the pipeline.

namespace lascaux {

/// A colour as the file says it: sRGB components, 0 to 1.
using Color = std::array<double, 3>;

/// One drawn line: consecutive cubic Béziers, each beginning where the one before ends.
///
/// Invariant: at least one piece; all coordinates finite; no piece of zero length unless `is_dot`.
struct Stroke {
  std::string svg_id;               ///< id of the element it came from, may be empty
  std::vector<CubicBezier> pieces;  ///< in sketch units
  bool closed = false;  ///< the last piece ends where the first begins, and the file says so
  bool is_dot = false;  ///< a zero-length stroke with a round cap: a point of diameter `width`
  double width = 0;     ///< pen width in sketch units, 0 when only filled
  std::optional<Color> stroke_color, fill_color;

  bool operator==(const Stroke&) const = default;
};

/// What is inside of a filled shape (SVG's fill-rule).
enum class FillRule : std::uint8_t { kNonZero, kEvenOdd };

/// An area that is painted with a colour and hides what was painted before it.
struct FilledArea {
  std::vector<std::vector<CubicBezier>> outlines;  ///< closed by straight lines where they are open
  FillRule rule = FillRule::kNonZero;
  Color color{};

  bool operator==(const FilledArea&) const = default;
};

/// A drawing. Sketch frame: x right, y down, in the root viewBox's user units.
///
/// A stroke's index is its id from here to the report. Order is the order of drawing.
struct Sketch {
  std::vector<Stroke> strokes;
  /// In the order of painting, less those that are lines' ink. They colour the model and take no
  /// part in its shape.
  std::vector<FilledArea> areas = {};

  bool operator==(const Sketch&) const = default;
};

/// Smallest box around all strokes (exact for the curves); empty for a sketch without strokes.
Eigen::AlignedBox2d Bounds(const Sketch& sketch);

}  // namespace lascaux

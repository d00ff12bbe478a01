#pragma once

#include <Eigen/Geometry>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/sketch.h"
#include "sketch/svg/cover.h"
#include "sketch/svg/path_builder.h"
#include "sketch/svg/reading.h"
#include "sketch/svg/style.h"

/// @file
/// From what elements draw to the strokes of a sketch.

namespace lascaux::svg {

/// What all subpaths of one element have in common.
struct Pen {
  std::string svg_id;
  pugi::xml_node element;
  Style style;
  Eigen::Affine2d to_sketch = Eigen::Affine2d::Identity();
  int order = 0;            ///< of the element among all that are drawn
  bool is_clipped = false;  ///< what it covers is not known
};

/// A subpath as it was painted, in the sketch frame.
struct PaintedSubpath {
  Stroke stroke;  ///< without pieces when it has no length and is no dot
  pugi::xml_node element;
  Eigen::Vector2d start;
  bool is_line = false, is_area = false;
  bool covers = false;  ///< it hides what was drawn before it
  bool is_ink = false;  ///< its area is a line's ink, and the line is there as well
  FillRule fill_rule = FillRule::kNonZero;
  int order = 0;  ///< of its element
  int dropped_pieces = 0;
};

/// Collects subpaths in the order of drawing.
class StrokeCollector {
 public:
  /// Takes one subpath of a visible element: brings it to the sketch frame, drops pieces of no
  /// length and joins the others. A subpath of no length is a dot if its line has round caps, else
  /// nothing.
  void Add(const Subpath& subpath, const Pen& pen);

  /// The sketch: lines if there are any, and the outlines of filled areas where there are none or
  /// where the lines are only details of them; of those that are equal (also when run through
  /// backwards) the first, with the fill of those that go; less what later areas hide. Linear but
  /// for a sort and what is hidden.
  ///
  /// Errors: "no-strokes", "not-finite". Notes: "duplicate-stroke", "hidden-line",
  /// "zero-length-piece". They are added to what `reading` has.
  Outcome<Sketch> Finish(Reading& reading) &&;

 private:
  std::vector<PaintedSubpath> painted_;
  pugi::xml_node not_finite_;  ///< the first element with coordinates out of range
};

}  // namespace lascaux::svg

#pragma once

#include <optional>

#include "lascaux/sketch/trace_picture.h"
#include "sketch/trace/gate.h"
#include "sketch/trace/rasterise.h"

namespace lascaux::trace {

/// The pen's width of a shape that is the outline of ink: twice its area over its perimeter, which
/// is exact for a long line of one width. 0 for a shape without area.
double InkWidthOf(const Contours& contours, FillRule rule);

/// Pen strokes in the units of the shape, and how well they are its ink.
struct CentreLines {
  std::vector<Stroke> strokes;
  GateFacts gate;  ///< its place is in the pixels that were worked on
};

/// The centre lines of ink that is drawn as a filled shape: rasterised at about eight pixels to its
/// width, and traced like a picture. Strokes have the ink's width and no colours.
///
/// Whether the shape is ink at all is for the caller to say (a small InkWidthOf against its size);
/// where gate.coverage is below 0.97, or gate.curve_regions differs from ink_regions, it
/// rather isn't. Nothing for a shape without area. At most 4 million pixels, 0.2 s: a shape that is
/// larger against its ink is worked on at fewer pixels to the width.
std::optional<CentreLines> CentreLinesOf(const Contours& contours, FillRule rule,
                                         const TracePictureOptions& options = {});

}  // namespace lascaux::trace

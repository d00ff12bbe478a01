#pragma once

#include <optional>

#include "lascaux/sketch/trace_picture.h"
#include "sketch/trace/gate.h"
#include "sketch/trace/rasterise.h"

namespace lascaux::trace {

/// The box at this many units to a pixel, with a margin that keeps it off the edge. At most
/// `most_pixels`: a box that is larger has larger pixels.
RasterFrame FrameAround(const Eigen::AlignedBox2d& box, double scale, double most_pixels);

/// Pen strokes in the frame's units, and how well they are the ink.
struct CentreLines {
  std::vector<Stroke> strokes;
  GateFacts gate;    ///< its place is in pixels
  double width = 0;  ///< of the ink
};

/// The centre lines of ink that was drawn as filled shapes: `ink` says how much of each pixel it
/// covers, and should have it about eight pixels wide. Areas far wider than the lines have their
/// outlines traced. Strokes have the ink's width and no colours.
///
/// Whether the shapes are ink at all is for the caller to say. Nothing where there is no ink.
/// Linear: 0.2 s for 4 million pixels.
std::optional<CentreLines> CentreLinesOf(Tone ink, const RasterFrame& frame,
                                         const TracePictureOptions& options = {});

}  // namespace lascaux::trace

#pragma once

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/sketch/bitmap.h"
#include "lascaux/sketch/sketch.h"

/// @file
/// The pen strokes of a picture as curves (docs/tracing.md has the method).
///
/// Source of the idea that junctions are repaired by extending their branches: G. Noris, A.
/// Hornung, R. W. Sumner, M. Simmons, M. Gross, "Topology-driven vectorization of clean line
/// drawings", ACM Transactions on Graphics 32(1), 2013. Curves are fitted by the method of P. J.
/// Schneider, "An algorithm for automatically fitting digitized curves", Graphics Gems, 1990.

namespace lascaux {

/// Limits of what is traced. Lengths are in ink widths, the pen's own measure, which is found in
/// the picture.
struct TracePictureOptions {
  int max_pixels = 40'000'000;  ///< of the picture
  double spur = 1.2;            ///< shorter branches with a free end are the paper's, not the pen's
  double junction = 1.5;        ///< junctions nearer to each other are one
  double corner = 50;           ///< degrees that a line turns within two widths at a corner

  bool operator==(const TracePictureOptions&) const = default;
};

/// What was traced, and how well the curves are the ink: they are drawn again with the ink's width
/// and compared.
struct TraceFacts {
  int width = 0, height = 0;  ///< of the picture
  double ink_width = 0;       ///< median, pixels of the picture
  double reduction = 1;       ///< pixels of the picture to one that was worked on, along each side
  double coverage = 0;        ///< share of the ink that the curves cover, 0 to 1
  int ink_regions = 0;        ///< regions that the ink cuts the page into, the outside included
  int curve_regions = 0;      ///< regions that the curves do

  bool operator==(const TraceFacts&) const = default;
};

/// Curves in the picture's pixels, x right and y down, and how good they are.
struct TracedPicture {
  Sketch sketch;
  TraceFacts facts;

  bool operator==(const TracedPicture&) const = default;
};

/// Coordinates of traced curves are multiples of this, so that a text file keeps them: pixels.
inline constexpr double kTraceGrid = 1e-4;

/// Traces the centre lines of the ink, and the outlines of areas that are filled with ink.
///
/// Uneven light is flattened and areas of flat colour vanish, because ink is what is darker than
/// both of its sides; a page darker than its drawing is turned round. Each stroke has the ink's
/// width. A stroke that ends on another does so within 1e-6 widths of it; lines go through
/// junctions where their tangents agree, so that a T has a bar and a stem.
///
/// Time and memory are linear in the pixels of the picture, with the work on at most 12 million.
/// The same picture gives the same curves for any number of threads.
///
/// Errors (input): "empty-page", no ink; "no-drawing", what is dark are no lines; "too-large".
/// Warning: "trace-incomplete" when the curves cover less than 99 % of the ink or cut the page into
/// another number of regions, with the place of the largest miss.
Outcome<TracedPicture> TracePicture(const Bitmap& picture, const TracePictureOptions& options = {},
                                    const Execution& execution = {});

}  // namespace lascaux

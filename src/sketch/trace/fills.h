#pragma once

#include "sketch/trace/ink.h"

namespace lascaux::trace {

/// Where areas are filled with ink.
struct Fills {
  Mask area;         ///< pixels of filled areas
  Mask interior;     ///< those further inside than a pen is wide
  double share = 0;  ///< of all that is dark
};

/// Dark areas that are no lines: thicker than `width` by far, and not as long as a broad brush's
/// stroke. What touches the picture's edge is no part of the drawing: a table, a shadow.
Fills FillsOf(const Mask& dark, double width);

}  // namespace lascaux::trace

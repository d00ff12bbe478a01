#pragma once

#include "sketch/trace/plane.h"

namespace lascaux::trace {

/// The ink of a picture, at the size that it is worked on.
struct Ink {
  Mask mask;                    ///< where coverage >= 0.5, less specks and with pinholes filled
  Tone coverage;                ///< how much of each pixel is ink, 0 to 1: finer than the mask
  Plane<std::int32_t> squared;  ///< squared distances of the mask
  double width = 0;             ///< median width of the ink, in its pixels
};

}  // namespace lascaux::trace

#pragma once

#include "lascaux/sketch/bitmap.h"
#include "sketch/trace/plane.h"

namespace lascaux::trace {

/// Lightness of a picture on a white page, 0 (ink) to 1: the mean of each `reduction` by
/// `reduction` pixels. Luma of the sRGB values, which are about as even to the eye.
Tone LightnessOf(const Bitmap& picture, int reduction);

/// `factor` times as many pixels along each side, bilinear.
Tone Enlarged(const Tone& tone, int factor);

/// True when the page is dark and the drawing light: most of the picture's edge is in the darker
/// half.
bool IsDarkPage(const Tone& lightness);

}  // namespace lascaux::trace

#pragma once

#include "sketch/trace/plane.h"

/// @file
/// Filters on whole planes, each linear in the pixels whatever its radius.

namespace lascaux::trace {

/// Three box filters in a row: a Gaussian of about `sigma` pixels. The edge is repeated outward.
Tone Blurred(const Tone& tone, double sigma);

/// Greatest (least) value in the square of side 2 radius + 1 around each pixel.
Tone Dilated(const Tone& tone, int radius);
Tone Eroded(const Tone& tone, int radius);

/// The grey closing: dark structures that no square of this radius fits into take the value of the
/// darkest of their sides.
Tone Closed(const Tone& tone, int radius);

/// Mean of each square of `factor` by `factor` pixels; what is left over at the right and below
/// goes into smaller ones.
Tone Reduced(const Tone& tone, int factor);

}  // namespace lascaux::trace

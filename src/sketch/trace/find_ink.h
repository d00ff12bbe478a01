#pragma once

#include <optional>

#include "sketch/trace/ink.h"

namespace lascaux::trace {

/// What is known of the ink before it is looked for.
struct FindInkOptions {
  /// Its width in pixels; when it is not known, anything up to 2 % of the picture is a line.
  std::optional<double> width;
};

/// The ink of a page that is light, at the page's own size; nothing when there is none.
///
/// Ink is what is darker than both of its sides: the ratio of the lightness to its closing, which
/// light that changes slowly and areas of flat colour leave at 1. A pixel is ink if it is at least
/// half as dark as the darkest one within a pen's width, so that faint lines and strong ones are
/// cut off at the same place. Areas as dark as the lines, but much wider, are fills: their rim is
/// their ink.
std::optional<Ink> FindInk(const Tone& lightness, const FindInkOptions& options);

/// How much darker than both of their sides the darker places of a picture are, 0 to 1; on an empty
/// page, however lit and grainy, next to nothing.
double ContrastOf(const Tone& lightness);

/// The ink of a mask: what is needed of it to trace it.
Ink InkOfMask(Mask mask, Tone coverage);

}  // namespace lascaux::trace

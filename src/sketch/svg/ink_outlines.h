#pragma once

#include <vector>

#include "sketch/svg/reading.h"
#include "sketch/svg/strokes.h"

/// @file
/// Lines that a drawing has as filled shapes: strokes converted to paths, brush strokes, traced
/// clip art.

namespace lascaux::svg {

/// If the dark fills of a page are the ink of its lines, marks them as ink and adds the lines'
/// middles to the end, on top of everything; else changes nothing.
///
/// They are when the ink that is seen (dark fills, less what later areas cover) is thin, less than
/// what it encloses, and nearly all of the drawing's outer edge. A silhouette encloses little, a
/// drawing in flat colours has other edges. Without dark fills it costs a look at the colours;
/// otherwise some hundredths of a second, and where lines are traced some tenths.
///
/// Note: "ink-outlines".
void TakeInkOutlines(std::vector<PaintedSubpath>& painted, Reading& reading);

}  // namespace lascaux::svg

#pragma once

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/read_svg.h"
#include "sketch/svg/document.h"

/// @file
/// The walk over a document that finds what is drawn.

namespace lascaux::svg {

/// Walks the document in the order of drawing and collects what draws a line, as ReadSvg() states.
Outcome<Sketch> ReadDrawing(const Document& document, const ReadSvgOptions& options);

}  // namespace lascaux::svg

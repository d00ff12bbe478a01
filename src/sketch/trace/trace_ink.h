#pragma once

#include <vector>

#include "lascaux/sketch/sketch.h"
#include "lascaux/sketch/trace_picture.h"
#include "sketch/trace/ink.h"

namespace lascaux::trace {

/// The strokes of the ink, in its pixels. A blot about as long as wide is a dot.
std::vector<Stroke> TraceInk(const Ink& ink, const TracePictureOptions& options);

}  // namespace lascaux::trace

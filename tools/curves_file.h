#pragma once

#include <string>

#include "model.h"

namespace lascaux {

/// The strokes of a drawing as a plain SVG document: one path a stroke, with its width, its fill
/// and its order. Reading it gives the same strokes again; the coordinates of traced ones are kept
/// exactly.
std::string CurvesText(const Model& model);

/// What `lascaux trace` found out about a picture, lascaux.trace/1, as JSON text (docs/tracing.md).
std::string TraceFactsText(const Model& model);

}  // namespace lascaux

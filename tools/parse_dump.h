#pragma once

#include <string>

#include "model.h"

namespace lascaux {

/// How the drawing was read, as JSON text, lascaux.parse/1: strokes, planar map, parts, depth
/// graph, skeletons, creature. What an error prevented is null. Coordinates are the sketch's own;
/// docs/report.md says what each field means.
std::string ParseDumpText(const Model& model);

}  // namespace lascaux

#pragma once

#include <string>

#include "model.h"

namespace lascaux {

/// How the drawing was read, as an SVG document that a person can check at a glance.
///
/// In the sketch's own coordinates, one layer (`<g id>`) each: parts in colour (the two sides of a
/// pair in one, the far one hatched), the drawn lines, closures of gaps in red, completions dashed,
/// skeletons with their discs, junctions and free ends, the body's mark, part ids, and each
/// diagnostic at its place with a number that the legend beside the drawing explains. Draws what
/// there is: after an error, what was found until then.
std::string ParsePictureText(const Model& model);

}  // namespace lascaux

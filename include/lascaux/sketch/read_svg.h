#pragma once

#include <cstddef>
#include <string_view>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/sketch.h"

/// @file
/// SVG 1.1 documents as drawings: everything that draws a line.

namespace lascaux {

/// Limits of what is taken for a drawing; a file beyond them is refused with a diagnosis, before it costs memory.
struct ReadSvgOptions {
  std::size_t max_bytes = 64u << 20;
  int max_pieces = 400'000;  ///< Bézier pieces, after `use` is expanded
  int max_depth = 200;       ///< nesting of elements and of `use`

  bool operator==(const ReadSvgOptions&) const = default;
};

/// Reads a document from its bytes.
Outcome<Sketch> ReadSvg(std::string_view bytes, const ReadSvgOptions& options = {});

}  // namespace lascaux

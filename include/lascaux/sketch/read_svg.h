#pragma once

#include <cstddef>
#include <string_view>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/sketch.h"

/// @file
/// SVG 1.1 documents as drawings: everything that draws a line.

namespace lascaux {

/// Limits of what is taken for a drawing; a file beyond them is refused with a diagnosis, before it
/// costs memory. Four steps of reading are allowed for each of `max_bytes`, which bounds what `use`
/// and style rules multiply.
struct ReadSvgOptions {
  std::size_t max_bytes = 64u << 20;  ///< of the file, of what it unpacks to, and of what its
                                      ///< entities stand for
  int max_pieces = 400'000;           ///< Bézier pieces, after `use` is expanded
  int max_depth = 200;                ///< nesting of elements and of `use`

  bool operator==(const ReadSvgOptions&) const = default;
};

/// Reads a document from its bytes: any bytes, in UTF-8, UTF-16, UTF-32 or Latin-1, as they are or
/// compressed by gzip (.svgz).
///
/// Strokes are what elements with a visible stroke draw: paths, basic shapes, and what `use` copies
/// of them, and small dark blobs. In a drawing without lines, or whose lines are only details of
/// its areas (they reach over less than 0.7 of its width or height), the outlines of filled areas
/// as well, but not those in the page's white or between areas of one colour. What opaque areas
/// cover that were drawn later is left out. Each subpath is a stroke, or several when it is hidden
/// in between. Styles come from attributes, `style` and style sheets (names, classes, ids,
/// nesting); clip paths, masks, dashes and markers have no effect. All curves become cubics:
/// exactly, but for elliptic arcs, which are followed to 5e-6 of their radii. Consecutive pieces
/// join exactly, and a closed stroke ends exactly where it begins.
///
/// Curves that are drawn twice, in either direction, are kept once, with the fill of those that go.
/// Pieces without length are dropped; a stroke of such is a dot if its caps are round, else
/// nothing.
///
/// Linear in the bytes plus the pieces, but for sorting: 0.05 ms for a drawing of 10 KB.
///
/// Errors, each with its place: "not-svg", "broken-xml", "no-strokes", "not-finite" (coordinates
/// must be at most 1e75, the drawing not smaller than 1e-75), "too-large". Warnings:
/// "bad-path-data" (what stands before the fault is kept), "bad-attribute", "bad-reference". Notes:
/// "duplicate-stroke", "hidden-line", "zero-length-piece", "ignored-element". Of each code at most
/// 20, and how many more there are.
Outcome<Sketch> ReadSvg(std::string_view bytes, const ReadSvgOptions& options = {});

}  // namespace lascaux

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lascaux/sketch/sketch.h"

/// @file
/// Colours and paints: with what, if with anything, lines and areas are drawn.

namespace lascaux::svg {

enum class PaintKind : std::uint8_t {
  kNone,
  kColor,
  kCurrentColor,  ///< whatever `color` is where the paint is used
  kOther,  ///< a gradient, a pattern, a colour in a notation that sketches have no use for: drawn,
           ///< colour unknown
};

struct Paint {
  PaintKind kind = PaintKind::kNone;
  Color color{0, 0, 0};
};

/// Reads the value of `fill` or `stroke`; nothing when it is none, so that the declaration is to be
/// ignored.
std::optional<Paint> ParsePaint(std::string_view text);

/// The sRGB value of one of the 147 colour names of SVG 1.1, as 0xrrggbb; ignores case.
std::optional<std::uint32_t> NamedColor(std::string_view name);

}  // namespace lascaux::svg

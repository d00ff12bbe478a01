#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "sketch/svg/cover.h"
#include "sketch/svg/length.h"
#include "sketch/svg/paint.h"
#include "sketch/svg/style_sheet.h"

/// @file
/// The computed style of an element: what presentation attributes, style sheets, `style` and the
/// parent make of it.

namespace lascaux::svg {

enum class LineCap : std::uint8_t { kButt, kRound, kSquare };

/// The initial values are those of a document that says nothing. Lengths in the element's user
/// units.
struct Style {
  // Inherited.
  Paint stroke{PaintKind::kNone, {}};
  Paint fill{PaintKind::kColor, {0, 0, 0}};
  Color color{0, 0, 0};
  double stroke_width = 1;
  double stroke_opacity = 1, fill_opacity = 1;
  FillRule fill_rule = FillRule::kNonZero;
  LineCap cap = LineCap::kButt;
  bool visible = true;
  // Not inherited, but what an element multiplies or removes stays so below it.
  double opacity = 1;  ///< of the element together with all groups around it
  bool displayed = true;
  std::string_view transform;  ///< the element's own, text

  /// True when lines are drawn at all, and when areas are.
  bool DrawsLine() const;
  bool DrawsArea() const;
  /// True when the area hides what was drawn before it.
  bool Covers() const;
  /// The colour, if the paint has one that is known.
  std::optional<Color> ColorOf(const Paint& paint) const;
};

/// A style with the work that the style sheets took (see SelectorMatch).
struct ComputedStyle {
  Style style;
  std::size_t cost = 0;
};

/// Cascades, weakest first: the parent's style, presentation attributes, rules by specificity and
/// order, the `style` attribute; then what is `!important`, in the same order. Declarations that
/// can't be read are ignored, as CSS rules.
ComputedStyle ComputeStyle(const Style& parent, const pugi::xml_node& element,
                           const StyleSheet& sheet, const Viewport& viewport);

}  // namespace lascaux::svg

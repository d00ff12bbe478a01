#pragma once

#include <optional>
#include <string_view>

#include "sketch/svg/cursor.h"

/// @file
/// Lengths with units, and the viewports that percentages refer to.

namespace lascaux::svg {

/// Pixels and user units of an inch, and pixels of the initial font, by CSS.
inline constexpr double kPixelsPerInch = 96;
inline constexpr double kInitialFontSize = 16;

/// Width and height of the nearest `svg` or `symbol` that establishes a coordinate system, in its
/// user units.
struct Viewport {
  double width = 300,
         height = 150;  ///< where nothing is said: the size that CSS gives to replaced elements

  /// What percentages of lengths in no particular direction refer to: the diagonal over sqrt(2).
  double Diagonal() const;
};

/// A length in user units, or why there is none.
struct Length {
  std::optional<double> value;
  Fault fault = Fault::kNone;
};

/// Reads "12.5", "3mm", "1e2px", "50%" (of `percent_of`). em, rem and ex refer to the initial font,
/// whatever font is set: drawings say their font sizes for text alone.
Length ParseLength(std::string_view text, double percent_of);

}  // namespace lascaux::svg

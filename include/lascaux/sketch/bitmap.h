#pragma once

#include <cstdint>
#include <vector>

/// @file
/// A picture as a reader hands it over: a scan, a photo, clip art.

namespace lascaux {

/// An 8-bit sRGB picture with straight alpha, 4 bytes a pixel, rows from the top.
///
/// Invariant: rgba.size() == 4 * width * height. The centre of pixel (x, y) is the sketch point
/// (x + 0.5, y + 0.5).
struct Bitmap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  bool operator==(const Bitmap&) const = default;
};

}  // namespace lascaux

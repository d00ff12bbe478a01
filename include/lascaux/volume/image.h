#pragma once

#include <cstdint>
#include <vector>

/// @file
/// A picture, as plain values.

namespace lascaux {

/// 8-bit sRGB with straight alpha, rows from the top, 4 bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  bool operator==(const Image&) const = default;
};

}  // namespace lascaux

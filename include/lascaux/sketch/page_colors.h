#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lascaux/sketch/bitmap.h"
#include "lascaux/sketch/sketch.h"

/// @file
/// The colours of a drawing without its lines.

namespace lascaux {

/// A raster over a drawing. Pixel (x, y) is the square at origin + pixel * (x, y), sketch units.
struct PageColors {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double pixel = 1;
  int width = 0, height = 0;
  std::vector<Eigen::Array3f> colors;  ///< linear light, sRGB primaries, 1 is the page's white
  std::vector<std::uint8_t> known;     ///< 0 under lines and beside the edges of areas

  std::size_t Index(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// What is painted on a page: the sketch's areas over each other, white where there is none. Next
/// to an area, up to 1.5 % of the drawing's diagonal, what is unpainted is not known: areas often
/// end beside the line that they belong to.
///
/// `longest` pixels along the longer side. Nothing for a sketch without areas. Linear in the pixels
/// of the areas: 10 ms for 768.
std::optional<PageColors> ColorsOf(const Sketch& sketch, int longest);

/// What is painted in a picture that `traced` was traced from, with the page's own colour, which
/// may change across it, made white. Lines, as wide as `traced` says, are not known.
///
/// Nothing for a dark page, where drawings are negatives. Linear in the picture's pixels.
std::optional<PageColors> ColorsOf(const Bitmap& picture, const Sketch& traced, int longest);

}  // namespace lascaux

#pragma once

#include <vector>

#include "lascaux/volume/image.h"

/// @file
/// A picture as light, before it is cut down to what a screen shows.

namespace lascaux {

/// What Picture::depth holds where the model is not seen: farther than anything, and finite, since
/// filters in other programs make nothing good of infinity.
inline constexpr float kNoDepth = 1e10F;

/// Rows from the top. The layers that were not asked for are empty.
struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgba;    ///< 4 a pixel: linear light, sRGB primaries, associated alpha
  std::vector<float> depth;   ///< from the camera along its axis, in the grid's world units
  std::vector<float> normal;  ///< 3 a pixel, in world axes, of length 1; 0 where nothing is seen
  std::vector<float> part;    ///< the part that is seen, -1 where there is none

  bool operator==(const Picture&) const = default;
};

/// The picture in 8 bits a channel for the screen: sRGB, straight alpha. Dithered by less than one
/// level in a fixed pattern, so that soft shadows show no steps.
Image ToImage(const Picture& picture);

/// Pictures of one size side by side, `columns` (at least 1) a row; cells left over look like the
/// first picture's upper left corner. Has the layers that all of them have.
///
/// Precondition: at least one picture, all of one size.
Picture ArrangePictures(const std::vector<Picture>& pictures, int columns);

/// Columns that make a sheet of `count` pictures about as wide as high, rather wider.
int SheetColumns(int count) noexcept;

}  // namespace lascaux

#pragma once

#include <array>
#include <vector>

#include "lascaux/sketch/bitmap.h"
#include "lascaux/sketch/sketch.h"
#include "support/cases.h"

/// @file
/// Pictures made for tests: strokes drawn by a round pen, and what scanners and cameras do to them.

namespace lascaux::testing {

/// An ideal page: how much of each pixel is ink, and the colour of what is painted under it.
class Page {
 public:
  Page(int width, int height);

  /// Draws with a round pen of the stroke's own width.
  void Draw(const Stroke& stroke);
  void Draw(const Sketch& sketch);
  /// Paints a disc under the ink.
  void Paint(const Eigen::Vector2d& center, double radius, const std::array<double, 3>& color);
  /// Fills a disc with ink.
  void Blot(const Eigen::Vector2d& center, double radius);

  /// Ink of this darkness on what is painted, seen in even light.
  Bitmap Seen(double ink = 0.05) const;

  int width, height;
  std::vector<double> ink;                    ///< 0 to 1 a pixel
  std::vector<std::array<double, 3>> colors;  ///< sRGB, 0 to 1
};

/// The same picture in light that falls off towards a corner, with a soft shadow across.
Bitmap Unevenly(Bitmap picture);
/// With grain of this deviation (of 255), and out of focus by about this many pixels.
Bitmap Grainy(Bitmap picture, double deviation, Random& random);
Bitmap Blurry(Bitmap picture, int radius);
/// As 8 x 8 blocks whose fine differences are rounded to multiples of `step`, as in JPEG.
Bitmap Blocky(Bitmap picture, double step);

/// The sketch as a pen of this width draws it on a page of this size, with a margin.
Sketch Placed(Sketch sketch, const Eigen::Vector2d& page, double width);

/// The largest distance from a point of `a` to `b`; dots count by their middles.
double Farthest(const Sketch& a, const Sketch& b);

}  // namespace lascaux::testing

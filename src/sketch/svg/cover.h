#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "lascaux/sketch/sketch.h"

/// @file
/// What filled areas hide of the lines that were drawn before them.

namespace lascaux::svg {

/// An opaque filled area.
class Cover {
 public:
  /// `outlines` are closed by straight lines where they are open; `order` is the element's place in
  /// the order of drawing. Curves are followed to `tolerance`.
  Cover(const std::vector<const std::vector<CubicBezier>*>& outlines, FillRule rule, int order,
        double tolerance);

  int order() const { return order_; }
  const Eigen::AlignedBox2d& box() const { return box_; }

  /// True inside of the area, more than `margin` from its outline. About the square root of the
  /// outline's points.
  bool Hides(const Eigen::Vector2d& point, double margin) const;

 private:
  struct Edge {
    Eigen::Vector2d a, b;
  };

  std::size_t BandOf(double y) const;

  FillRule rule_;
  int order_;
  std::vector<Edge> edges_;
  Eigen::AlignedBox2d box_;
  std::vector<std::vector<std::size_t>> bands_;  ///< indices of the edges that touch a band of y
};

/// What is left of a stroke under covers that were drawn after it (those with a higher order than
/// its own): itself, untouched, where nothing hides it; else its visible stretches. A stretch along
/// a cover's own outline, within half a pen width or `tolerance`, is visible.
std::vector<Stroke> VisibleStretches(const Stroke& stroke, int order,
                                     const std::vector<Cover>& covers, double tolerance);

}  // namespace lascaux::svg

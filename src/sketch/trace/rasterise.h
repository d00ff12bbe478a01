#pragma once

#include <vector>

#include "lascaux/sketch/sketch.h"
#include "sketch/trace/plane.h"

namespace lascaux::trace {

/// Closed contours, each a chain of curves; one that is open is closed by a straight line.
using Contours = std::vector<std::vector<CubicBezier>>;

/// Where a plane lies: pixel p is the point origin + scale * p.
struct RasterFrame {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double scale = 1;
  int width = 0, height = 0;
};

/// The share of each pixel that a filled shape covers: exact along rows, sampled at four heights.
Tone Rasterised(const Contours& contours, FillRule rule, const RasterFrame& frame);

}  // namespace lascaux::trace

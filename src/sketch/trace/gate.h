#pragma once

#include <optional>
#include <vector>

#include "lascaux/sketch/sketch.h"
#include "sketch/trace/ink.h"

namespace lascaux::trace {

/// How well strokes are the ink that they were traced from.
struct GateFacts {
  double coverage = 0;  ///< share of the ink's pixels that they cover
  int ink_regions = 0;  ///< regions of the page, at least a pen's width in square
  int curve_regions = 0;
  std::optional<Eigen::Vector2d> worst;  ///< middle of the largest miss, if there is any
};

/// Draws the strokes (in the ink's pixels) again, as wide as the ink is around their middles, and
/// compares.
GateFacts Compare(const std::vector<Stroke>& strokes, const Ink& ink);

}  // namespace lascaux::trace

#pragma once

#include "sketch/trace/ink.h"
#include "sketch/trace/ink_graph.h"

namespace lascaux::trace {

/// The coverage at any point, between pixel centres bilinear; 0 outside of the plane.
double CoverageAt(const Tone& coverage, const Eigen::Vector2d& point);

/// The mean diameter of a blot around its middle, from what is known of its half-width.
double BlotWidthAt(const Tone& coverage, const Eigen::Vector2d& at, double half_width);

/// Moves the points of all branches from pixels to the middle of the ink, halfway between the
/// places on both sides where it covers half; measures its half-width there; ends free ends
/// where a round pen's stroke would. Points within junctions are smoothed only.
void Centre(InkGraph& graph, const Ink& ink);

}  // namespace lascaux::trace

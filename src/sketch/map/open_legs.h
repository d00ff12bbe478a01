#pragma once

#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/map/closures.h"

/// @file
/// Legs behind others that are drawn as open lines: one flank and a foot, the rest is hidden.

namespace lascaux {

/// Closures, at most `reach` (sketch units) long, that make cells of such legs; two for a line that
/// touches nothing, one for a line that begins on the outline. Their price is nothing: what they
/// have to enclose is looked at here.
///
/// The line lies outside, begins in the lower part of the drawing and comes down to its lowest
/// third, turns there into a foot (a line that just ends is a tail, or a leg without width), and
/// with the outline encloses what is longer than wide.
std::vector<Closure> FindOpenLegs(const PlanarMap& map, double reach);

}  // namespace lascaux

#pragma once

#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/map/arrangement.h"

/// @file
/// Gaps in the outline: found on the outer walk, closed if they are small, named if they are not.

namespace lascaux {

/// Closes the gaps of a map that was arranged from `lines` (snapped), with a warning "gap-closed"
/// for each.
///
/// Only free ends on the outside are gaps: an open end inside a bounded face is a suggestive
/// curve's by design. A free end joins another free end, or the line that it points at, within
/// options.bridge, if that closes a face worth having. Where no face holds the animal afterwards,
/// slits between lines that run side by side are closed as well ("slit-closed"); if even that is
/// not enough: error "outline-open" at the narrowest place that would have to be closed.
Outcome<PlanarMap> CloseGaps(PlanarMap map, std::vector<ArrangementLine> lines,
                             const BuildPlanarMapOptions& options);

}  // namespace lascaux

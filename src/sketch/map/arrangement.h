#pragma once

#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/map/polyline.h"

/// @file
/// Lines cut where they meet: the geometry of the planar map.

namespace lascaux {

/// A flattened stroke (or the closure of a gap) to arrange.
struct ArrangementLine {
  Polyline points;  ///< at least two, no two in a row equal; a closed line repeats its first point
                    ///< at the end
  int stroke = -1;
  bool closed = false;
  double snap = 0;  ///< how far its ends look for another line, in sketch units

  bool operator==(const ArrangementLine&) const = default;
};

/// How many crossings a drawing may have before it is taken for a scribble.
inline constexpr int kMaxCrossings = 200'000;

/// Moves ends that are near each other to one place, and others onto the line that they are near
/// (§4.1: curves are connected at nodes).
///
/// Ends look as far as their line's snap radius, and farther in a drawing where many ends miss the
/// line that they are nearest to: there ends that have crossed a line are cut off, too, and lines
/// are bent from farther off to where their ends are moved. What ends look as far as is the lines'
/// snap radius afterwards.
std::vector<ArrangementLine> SnapEnds(std::vector<ArrangementLine> lines, double diagonal);

/// Cuts the lines at their ends, touches and crossings, and removes spurs (dangling pieces shorter
/// than their line's snap radius).
///
/// Errors: "too-tangled".
Outcome<PlanarMap> Arrange(const std::vector<ArrangementLine>& lines, double diagonal);

/// Sorts the edges around each node and finds `next`, `cycle` and `cycles` with their kinds.
PlanarMap TraceCycles(PlanarMap map);

/// The map without some of its edges (one flag an edge), its cycles traced anew. Edges keep their
/// order, nodes that no edge touches are gone.
PlanarMap WithoutEdges(const PlanarMap& map, const std::vector<bool>& drop);

}  // namespace lascaux

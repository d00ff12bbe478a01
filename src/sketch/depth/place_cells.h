#pragma once

#include "lascaux/sketch/depth_graph.h"
#include "sketch/depth/adjacency.h"

/// @file
/// Closed cells that are neither the body nor a limb's far side.

namespace lascaux {

/// Hangs every cell that `graph` has no place for on the part that it shares the longest line with,
/// outwards from the body: beside a limb's far end it is more of that limb, beside its root it
/// belongs to the limb's parent. Legs and ears among them (SideCells) become foreground, and the
/// far side of one another where two are alike; the rest lies in the plane. Cells that touch
/// nothing are ignored. O(n^2) in the cells.
void PlaceCells(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
                DepthGraph& graph);

}  // namespace lascaux

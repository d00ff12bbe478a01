#pragma once

#include "lascaux/skeleton/skeleton.h"
#include "skeleton/ring.h"

/// @file
/// The medial axis of a closed polyline, from the Voronoi diagram of its samples.
///
/// Source: S. Fortune, "A sweepline algorithm for Voronoi diagrams", Algorithmica 2, 1987
/// (Boost.Polygon's implementation).

namespace lascaux {

/// The tree of discs centred at the Voronoi vertices inside the ring; empty when there is none
/// inside.
///
/// Samples are added where the ring comes nearer to itself than twice their distance, so that the
/// diagram separates the inside from the outside; then the dual of the outline's own edges cuts it,
/// and what remains inside a simple outline is a tree (the dual of a triangulation without inner
/// vertices). On outlines that cross themselves the largest tree of discs whose centres are inside
/// is taken. Radii are distances to the polyline, not to its samples. Coordinates are rounded to
/// 2^-28 of the ring's extent.
Skeleton MedialAxis(const Ring& ring);

}  // namespace lascaux

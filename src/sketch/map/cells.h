#pragma once

#include "lascaux/sketch/planar_map.h"

/// @file
/// Small cells: hooves, bands, toes, the slivers between strokes that almost coincide.

namespace lascaux {

/// Merges cells that are no parts by themselves with the neighbour that they share the longest line
/// with: enclosed cells, and border cells of less than a small share of the animal. Islands stay. A
/// note "cell-merged" for each.
///
/// The paper's "others" (§4.1) have no edge on the outside, so no structural part comes from them;
/// left alone they would be holes.
Outcome<PlanarMap> MergeCells(PlanarMap map);

}  // namespace lascaux

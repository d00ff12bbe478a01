#pragma once

#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/map/closures.h"

/// @file
/// Closed outlines that almost touch what they belong to.

namespace lascaux {

/// Closures, free of charge, between the corners of a closed outline that lies outside of all
/// others and the lines just beside it.
///
/// Where ends meet two by two at a corner of a leg and at one of the body, no end is free, and no
/// gap is seen; but the leg touches nothing. Nothing is to be enclosed for such closures: those
/// that enclose nothing are of no use.
std::vector<Closure> FindContacts(const PlanarMap& map);

}  // namespace lascaux

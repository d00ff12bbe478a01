#pragma once

#include "lascaux/skeleton/skeleton.h"

/// @file
/// Pruning of medial axes by the scale axis transform.
///
/// Source: J. Giesen, B. Miklos, M. Pauly, C. Wormser, "The Scale Axis Transform", SoCG 2009.

namespace lascaux {

/// The smallest subtree that holds every disc which, with all radii times `scale` (> 1), shows on
/// the boundary of the union.
///
/// A disc of the tree is on the medial axis of the union of the grown discs exactly if it
/// contributes to its boundary; we keep the paths between those too, so that the result is a tree
/// like the input, and the radii are the input's. A corner of more than 2 asin(1 / scale), 113
/// degrees at 1.2, loses its branch, and so do bumps lower than a sixth of the radius that they
/// stand on. Leaves are peeled in turn: the union of what remains never changes, hence the order
/// does not matter.
Skeleton ScaleAxis(const Skeleton& axis, double scale);

}  // namespace lascaux

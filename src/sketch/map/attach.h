#pragma once

#include <vector>

#include "sketch/map/closures.h"

/// @file
/// Lines inside of the animal that end just before the line that they belong to.

namespace lascaux {

/// Closures for free ends inside of faces, one an end at most.
///
/// An open end in a face is a suggestive curve's by design, so little is taken for a slip: an end
/// that points at a line and stops just before it, or at another end that points back. A path that
/// is free at both ends is no suggestive curve yet: its better end may be farther away, unless the
/// path is no longer than a few gaps (an eye, a wrinkle).
std::vector<Closure> FindAttachments(const PlanarMap& map);

}  // namespace lascaux

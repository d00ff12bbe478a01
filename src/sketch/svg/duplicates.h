#pragma once

#include <cstddef>
#include <vector>

#include "lascaux/sketch/sketch.h"

/// @file
/// Curves that are drawn more than once.

namespace lascaux::svg {

/// For each stroke the index of the first one that runs along the same curve, in either direction;
/// its own index when that is itself. Curves are the same when their control points differ by less
/// than 1e-7 of the diagonal of all: as much as other transforms and rounded digits make of one
/// drawing. (Two in about a million that are that near but not equal are told apart: they fall on
/// both sides of a rounding.) Linear.
std::vector<std::size_t> FirstOfEach(const std::vector<const Stroke*>& strokes);

}  // namespace lascaux::svg

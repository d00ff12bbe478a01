#pragma once

#include "sketch/trace/plane.h"

namespace lascaux::trace {

/// The squared Euclidean distance from each pixel of the mask to the nearest pixel outside of it, 0
/// outside. Exact, after Felzenszwalb and Huttenlocher (2012); linear in the pixels.
Plane<std::int32_t> SquaredDistances(const Mask& mask);

/// Half the width of the ink around a pixel, from the squared distance: the boundary runs half a
/// pixel before the nearest pixel outside.
double HalfWidth(std::int32_t squared_distance);

}  // namespace lascaux::trace

#pragma once

#include <vector>

#include "sketch/trace/plane.h"

namespace lascaux::trace {

/// Which neighbours belong together: ink touches at corners, the page between it does not.
enum class Neighbours : std::uint8_t { kEdges, kCorners };

/// A connected set of pixels, by index in the plane.
using Region = std::vector<std::int32_t>;

/// The connected regions of pixels whose value in the mask is `value`, in raster order of their
/// first pixels. Linear.
std::vector<Region> RegionsOf(const Mask& mask, std::uint8_t value, Neighbours neighbours);

}  // namespace lascaux::trace

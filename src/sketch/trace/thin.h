#pragma once

#include "sketch/trace/plane.h"

namespace lascaux::trace {

/// The centre lines of the ink, one pixel wide: its pixels are removed from the outside inward, by
/// growing distance from its boundary, as long as that joins and parts nothing; ends of lines stay.
///
/// As many pieces and holes as the mask has (ink 8-connected, page 4-connected). n log n in the
/// pixels of ink.
Mask Thinned(const Mask& mask, const Plane<std::int32_t>& squared_distances);

}  // namespace lascaux::trace

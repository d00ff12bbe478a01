#pragma once

#include <array>
#include <cstdint>

#include "lascaux/volume/mesh.h"

namespace lascaux {

/// Do two triangles with area share more than the corners and the edge that they share by index?
///
/// Exact. A separating plane found in double precision, by a margin that covers its rounding,
/// answers for nearly all neighbours in a smooth mesh; the rest is left to exact predicates.
bool PairIntersects(const Mesh& mesh, const std::array<std::uint32_t, 3>& a,
                    const std::array<std::uint32_t, 3>& b);

}  // namespace lascaux

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh.h"

namespace lascaux {

/// Number of pairs of triangles that share more than their common corners and edge, decided
/// exactly.
///
/// Only the triangles in `of` (ascending) are looked at; they have area, finite corners and indices
/// in range. Boxes are paired in a uniform grid, so the cost is linear for triangles of like size.
/// Empty when cancelled.
std::optional<std::int64_t> CountSelfIntersections(const Mesh& mesh,
                                                   const std::vector<std::uint32_t>& of,
                                                   const Execution& execution);

}  // namespace lascaux

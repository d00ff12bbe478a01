#pragma once

#include <optional>
#include <vector>

#include "sketch/depth/adjacency.h"

/// @file
/// Far-side partners of limbs (§5.1).

namespace lascaux {

/// A part's near limb.
struct FarSide {
  int limb = 0;
  double score = 0;        ///< how alike it is to the limb, 1 to 0 (RoleChoice)
  double other_score = 0;  ///< to the next best limb; 0 if there is none
};

/// For every part the limb whose drawn far side (or a piece of it) it is.
///
/// Candidates are border parts that share a line with the limb or are met marching from its root
/// along its parent. The paper takes those within 45 degrees of the limb's axis at the joint. Thin
/// legs with joints side by side break that rule, so the tips count as well: direction and
/// distance, seen from the limb's top. As many limbs as possible get a far side (augmenting paths,
/// most alike first); cells that touch nothing but a limb and its far side go with it.
std::vector<std::optional<FarSide>> FindFarSides(const PlanarMap& map, const Parts& parts,
                                                 const Adjacency& adjacency, int body);

}  // namespace lascaux

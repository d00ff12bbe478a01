#pragma once

#include <vector>

#include "lascaux/skeleton/creature.h"

/// @file
/// How deep a body is from place to place.

namespace lascaux {

/// Stations for the body's chains. Along the longest chain: the middle, above and below of each
/// section, in proportion to how much the section belongs to the torso (the thick part). Sections
/// stay as deep as the mean of their neighbourhood where they are taller. Chains that rise from the
/// torso's back and are short for their width are fins and humps, and get thin towards their tips.
std::vector<DepthStation> ShapeTorso(const std::vector<Chain>& chains,
                                     const PlaceInDepthOptions& options);

}  // namespace lascaux

#pragma once

#include <optional>
#include <vector>

#include "lascaux/skeleton/creature.h"
#include "skeleton/part_surface.h"
#include "skeleton/ring.h"

/// @file
/// Where the limbs of a pair, and islands, lie in depth.

namespace lascaux {

/// What a limb grows out of: a parent by its surface and, in its own plane, by its outline, which
/// is what it will be fitted to.
struct LimbParent {
  const CreaturePart& part;
  const PartSurface& surface;
  const Ring& outline;
};

/// Depths of a limb.
struct LimbShape {
  std::vector<DepthStation> stations;  ///< first those of its discs, in the order of the chains
  double z = 0;                        ///< of the free end
  std::optional<Chain> shoulder;       ///< a further chain, hidden in the parent
  double pushed = 0;  ///< how much further out that is than it would be by itself, in radii there
};

/// Depths of a limb over its parent by the rules of PlaceInDepth(); `part` is its drawing.
LimbShape ShapeLimb(const CreaturePart& limb, const Part& part, const LimbParent& parent,
                    const PlaceInDepthOptions& options);

/// An island: a lens that lies in its parent's surface and follows its slope. Its middle is inside
/// of the parent.
LimbShape ShapeIsland(const CreaturePart& island, const LimbParent& parent);

/// The disc of the largest radius.
SkeletonVertex LargestDisc(const CreaturePart& part);

}  // namespace lascaux

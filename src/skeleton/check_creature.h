#pragma once

#include "lascaux/base/diagnostic.h"
#include "lascaux/skeleton/creature.h"
#include "lascaux/sketch/parts.h"

namespace lascaux {

/// Errors with the code "bad-primitive" for all of a creature that can neither be fitted nor
/// placed; empty when all is well.
///
/// Each names its part, chain and disc. Refused are: a part that is not among `parts`; one without
/// discs; a parent that is not an earlier part; a disc that is not finite or whose radius is not
/// above 0. Discs that coincide, and chains shorter than their radii, are fine.
Diagnostics CheckCreature(const Parts& parts, const Creature& creature);

}  // namespace lascaux

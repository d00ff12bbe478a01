#pragma once

#include "lascaux/sketch/parts.h"

/// @file
/// Outlines of parts that only abut their parent, extended into it.

namespace lascaux {

/// What a part's skeleton is made of: its outline, with each joint with `parent` replaced by a
/// round end that reaches into the parent by half of the joint's width, deeper than the joint
/// itself, and continues the tangents of its sides (turned towards the parent where they flare by
/// more than 45 degrees from it). The new pieces are kCompletion.
///
/// Joints are the runs of kShared pieces on the parent's outline, to 0.3 % of its diagonal; where
/// there is none, as when a limb lies between, the nearest run, and its end is longer by the
/// distance. An end that would show outside of the part, the parent and the limbs over the parent
/// is made shallower, down to a fifth; if it still shows, the joint stays as drawn. Limbs, which
/// have completions, and islands are returned as they are.
Outline OutlineToFill(const Parts& parts, int part, int parent);

}  // namespace lascaux

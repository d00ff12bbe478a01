#pragma once

#include "lascaux/sketch/parts.h"

/// @file
/// Outlines of parts that only abut their parent, extended into it.

namespace lascaux {

/// The outline with each piece that it shares with `parent` replaced by a round end that reaches
/// into the parent, half of the joint's width deeper than the piece itself, continuing the tangents
/// of the sides (turned towards the parent where they flare by more than 45 degrees from it). The
/// new pieces are kCompletion.
///
/// A joint is a run of kShared pieces whose middle lies on the parent's outline, to `tolerance`
/// (sketch units). An extension that would leave parent and part is made shallower, down to a
/// fifth; if it still leaves them the joint stays as drawn.
Outline ExtendInto(const Outline& outline, const Outline& parent, double tolerance);

/// What a part's skeleton is made of: its outline, extended into `parent` if it only abuts it.
Outline OutlineToFill(const Parts& parts, int part, int parent);

}  // namespace lascaux

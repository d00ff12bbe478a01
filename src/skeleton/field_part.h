#pragma once

#include "lascaux/field/field.h"
#include "lascaux/skeleton/creature.h"

/// @file
/// The field of one part by itself.

namespace lascaux {

/// The drawn side of the part, without a parent.
FieldPart MakeFieldPart(const CreaturePart& part, const ModelFrame& frame);

/// The same on the other side of z = 0, without a parent.
FieldPart MirrorImage(const FieldPart& part);

}  // namespace lascaux

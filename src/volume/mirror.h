#pragma once

#include "lascaux/field/field.h"

namespace lascaux {

/// Does every part have a mirror image across z = 0, with the parent's mirror image for a parent?
/// A part in the plane is its own.
///
/// Exact comparison: a field for which this holds is the same at z and -z but for rounding.
bool IsMirrorSymmetric(const Field& field);

}  // namespace lascaux

#pragma once

#include "model.h"

namespace lascaux::testing {

/// A model made by hand: a body of 4 by 2 sketch units with a near limb, its far side in two
/// pieces, an eye and an ignored crumb. One sketch unit is 10 mm.
Model SampleModel();

}  // namespace lascaux::testing

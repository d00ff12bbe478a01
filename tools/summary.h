#pragma once

#include <vector>

#include "lascaux/base/diagnostic.h"
#include "model.h"
#include "output_plan.h"

namespace lascaux {

/// The note at the end of a run that went well: what was found, how large and how faithful it is,
/// where it was written.
Diagnostic Summary(const Model& model, const std::vector<OutputTarget>& targets);

}  // namespace lascaux

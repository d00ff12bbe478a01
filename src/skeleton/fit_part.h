#pragma once

#include <vector>

#include "lascaux/skeleton/creature.h"
#include "lascaux/skeleton/fit.h"

/// @file
/// The fit of one part in its plane.

namespace lascaux {

/// The chains fitted to `outline`; those given, when no step makes the largest error smaller. That
/// it is not larger is checked at twice as many samples as are fitted.
std::vector<Chain> FitChains(const std::vector<Chain>& chains, const Outline& outline,
                             const FitOptions& options);

/// The error of the chains' silhouette against the drawn pieces of `outline`, at samples `spacing`
/// of its diagonal apart.
FitError MeasureChains(const std::vector<Chain>& chains, const Outline& outline, double spacing);

}  // namespace lascaux

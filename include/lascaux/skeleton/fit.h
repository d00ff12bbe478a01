#pragma once

#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/skeleton/creature.h"
#include "lascaux/sketch/parts.h"

/// @file
/// The fit: discs moved and scaled until each part's silhouette runs along its drawn outline.
///
/// Source: K. Levenberg, "A method for the solution of certain non-linear problems in least
/// squares", 1944; D. Marquardt, 1963.

namespace lascaux {

/// Lengths are relative to the diagonal of each part's own bounds.
struct FitOptions {
  int max_steps = 16;
  double target = 5e-4;  ///< a part is done when no drawn piece is further from its silhouette
  double sample_spacing = 1e-2;    ///< of the outlines, which have 128 samples at least
  double completion_weight = 0.1;  ///< of completions and joints, against 1 for drawn pieces
  double regularization = 0.5;     ///< how the first step holds discs in place (Tikhonov)

  bool operator==(const FitOptions&) const = default;
};

/// How far a part's silhouette, by itself, is from the drawn pieces of its outline; in shares of
/// the part's diagonal.
struct FitError {
  double mean = 0, max = 0;

  bool operator==(const FitError&) const = default;
};

/// The creature with the positions and radii of its discs changed so that each part by itself has
/// its drawn outline as its silhouette; depths, chains and their numbers of vertices stay.
///
/// A part's skeleton is planar, so its silhouette is the line f(x, y, z) = 1 in its plane:
/// Gauss-Newton on log radius and position of each vertex, with analytic derivatives, over even
/// samples of the outline; the residual is the distance estimate of SignedDistance(). Joints with
/// parts that abut the part weigh as little as completions, for the blend covers them; other shared
/// pieces are the part's own contour. Each part ends no worse, in its largest error over samples
/// half as far apart as those that are fitted, than it began. Typical largest error: 1 to 6 %
/// before, 0.05 to 0.6 % after. Parts run in parallel; 0.3 ms a step for a body.
///
/// Errors: "bad-primitive" for discs that are not finite or whose radius is not above 0, for parts
/// without discs and for those that are not in the drawing; each names its part.
Outcome<Creature> FitToDrawing(const Parts& parts, const Creature& creature,
                               const FitOptions& options = {}, const Execution& execution = {});

/// The error of each of the creature's parts, over samples `spacing` of its diagonal apart.
std::vector<FitError> MeasureFit(const Parts& parts, const Creature& creature,
                                 double spacing = 4e-3);

}  // namespace lascaux

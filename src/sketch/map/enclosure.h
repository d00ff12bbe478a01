#pragma once

#include <vector>

#include "lascaux/base/outcome.h"
#include "sketch/map/arrangement.h"
#include "sketch/map/closures.h"

/// @file
/// Which gaps to close: all of them together, as the least-cost outline around the drawing.

namespace lascaux {

/// The closures, as indices in ascending order, that separate inside from outside at the least
/// cost: the prices of the closures that are used, plus the area of the faces that stay outside.
///
/// The faces that lines and closures make are the nodes of a graph, in which the cheapest cut
/// between the outside and the wish to be inside is found by maximum flow. So several gaps of one
/// outline are closed together or not at all, and of several ways the cheapest is taken. LazyBrush
/// (Sýkora et al. 2009) fills drawings with gaps by the same idea, on pixels. `lines` are those
/// that the closures were found for.
///
/// Errors: those of Arrange().
Outcome<std::vector<std::size_t>> ChooseClosures(std::vector<ArrangementLine> lines,
                                                 const std::vector<Closure>& closures,
                                                 double diagonal);

}  // namespace lascaux

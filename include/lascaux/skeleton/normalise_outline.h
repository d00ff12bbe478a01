#pragma once

#include "lascaux/base/execution.h"
#include "lascaux/field/field.h"
#include "lascaux/skeleton/creature.h"
#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"

/// @file
/// The last tenth of a per cent: the field's silhouette put exactly on the drawn outline.

namespace lascaux {

/// What the outline of the model is to be: the parts that are built, and where they stand in model
/// units.
struct DrawnOutline {
  const Parts& parts;
  const DepthGraph& graph;
  const ModelFrame& frame;
};

/// The field with a planar gain that makes its silhouette the drawn outline.
///
/// With m(x, y) the maximum of F over z, gain = 1/m on the drawn pieces of the union of the parts
/// that are built: max F is then 1 on them, whatever fit and blend left. The logarithm of the gain
/// is a sum of smooth kernels along the outline, which fade on both sides without a seam: kernels
/// about 0.6 local radii wide for what changes slowly along the outline, and for the wobbles of the
/// pen narrow ones that keep these from going round the body as rings. Completions and joints are
/// no outline, and where one part takes over
/// from another the gain is let go: the fillet there stays. log m is limited to kMostLogGain; where
/// the field is further off, it is missing something that a factor cannot make. About 2000 samples,
/// 39 field values each.
Field NormaliseOutline(Field field, const DrawnOutline& drawn, const Execution& execution = {});

/// A shift of the surface by about 40 % of the local radius.
inline constexpr double kMostLogGain = 1.0;

}  // namespace lascaux

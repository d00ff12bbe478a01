#pragma once

#include "lascaux/sketch/depth_graph.h"
#include "sketch/depth/adjacency.h"

/// @file
/// Which part is the torso (§5.1; the paper asks for a click, here it is found).

namespace lascaux {

struct BodyChoice {
  int part = 0;
  double margin = 0;  ///< 1 - score of the next best over its own
};

/// The border part with the greatest area times one for itself, one for each limb over it and a
/// half for each part beside it, less the farther it is from the middle of the drawing. A limb is
/// never the body. With options.body: the part that holds this point. Errors: "body-not-there".
Outcome<BodyChoice> FindBody(const Parts& parts, const Adjacency& adjacency,
                             const OrderByDepthOptions& options);

}  // namespace lascaux

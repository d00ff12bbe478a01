#pragma once

#include "lascaux/sketch/planar_map.h"

namespace lascaux {

/// Heights between which the drawing lies, as seen on the page: y grows downwards.
struct Heights {
  double top = 0, bottom = 0;
};

/// The map must have a node.
Heights HeightsOf(const PlanarMap& map);

}  // namespace lascaux

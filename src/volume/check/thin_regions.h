#pragma once

#include <vector>

#include "lascaux/volume/wall_thickness.h"
#include "volume/check/triangle_grid.h"

namespace lascaux {

/// TellThinPlaces() of wall_thickness.h where a grid of the mesh is there already.
ThinPlaces TellThinPlaces(const Mesh& mesh, const std::vector<Wall>& walls, double limit,
                          const TriangleGrid& grid);

}  // namespace lascaux

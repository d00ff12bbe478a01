#pragma once

#include <vector>

#include "lascaux/volume/narrow_band.h"

namespace lascaux {

/// The cells of `after`, by its blocks, that have the same eight values at their corners in
/// `before`. Both bands have the same lattice; cells outside of the blocks of either are no cells.
/// Linear.
std::vector<VoxelMask> UnchangedCells(const NarrowBand& before, const NarrowBand& after);

}  // namespace lascaux

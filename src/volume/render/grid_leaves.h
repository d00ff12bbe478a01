#pragma once

#include <openvdb/openvdb.h>

#include "volume/render/leaf_table.h"

namespace lascaux {

/// The leaves of a grid, which must outlive them. What a tile of the tree says counts where there
/// are leaves around it; further out is outside.
LeafTable LeavesOf(const openvdb::FloatGrid& grid);

}  // namespace lascaux

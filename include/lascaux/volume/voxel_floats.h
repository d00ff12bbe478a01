#pragma once

#include <vector>

#include "lascaux/base/unset_allocator.h"

namespace lascaux {

/// A number for each voxel, unset by resize(): threads fill the blocks that they work on.
using VoxelFloats = std::vector<float, UnsetAllocator<float>>;

}  // namespace lascaux

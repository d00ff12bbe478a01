#pragma once

#include <openvdb/openvdb.h>

#include "model.h"

namespace lascaux {

/// A level set in the model frame, millimetres.
struct Grid {
  openvdb::FloatGrid::Ptr surface;
};

/// Measures the grid.
inline GridFacts FactsOf(const openvdb::FloatGrid& grid) {
  return {grid.voxelSize()[0], static_cast<std::int64_t>(grid.activeVoxelCount()),
          static_cast<std::int64_t>(grid.memUsage())};
}

}  // namespace lascaux

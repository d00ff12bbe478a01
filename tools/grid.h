#pragma once

#include <cstdint>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/narrow_band.h"
#include "model.h"

namespace lascaux {

/// A level set in the model frame, millimetres.
struct Grid {
  NarrowBand surface;
};

/// Measures the level set.
inline GridFacts FactsOf(const NarrowBand& band) {
  constexpr std::size_t kBytes = kBlockVoxels * sizeof(float) + sizeof(VoxelMask);
  return {band.voxel_size, CountActive(band), static_cast<std::int64_t>(kBytes * band.size())};
}

/// The voxel centres, between which the mesh has its vertices.
inline Lattice LatticeOf(const NarrowBand& band) { return {band.origin, band.voxel_size}; }

}  // namespace lascaux

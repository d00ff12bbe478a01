#pragma once

#include <openvdb/openvdb.h>

#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/model_volume.h"

/// @file
/// A model as OpenVDB's grids.

namespace lascaux {

/// The grids of a model on one lattice of voxels, in this order and by these names:
///
/// - "surface": the level set.
/// - "density", a fog volume (tools::sdfToFogVolume): 1 inside, falling to 0 at the surface over
///   the three voxels below it.
/// - "Cd", the linear colour (Vec3f; model.colors at the voxel, or its part's), and "part", the
/// index (float, since programs stumble over
///   grids of integers; -1 outside), of the part that each voxel belongs to (PartOfPoints): active
///   in the band and inside. Where no part reaches it is the first.
/// - "part_NAME" for each part, letters, digits and '_' only: the level set of the part by itself.
///   Each lies within the surface; together they are the surface without what blending adds.
///
/// A part that is thinner than the voxels has no level set, and a note "part-not-in-volume" says
/// so. Errors are RasteriseBand's. The same grids for any number of threads.
Outcome<std::vector<openvdb::GridBase::ConstPtr>> VolumeGrids(const ModelVolume& model,
                                                              const Execution& execution = {});

/// "Cd" and "part" for pictures: within two voxels of the surface alone, which must be the level
/// set of model.surface, y up.
struct ColorGrids {
  openvdb::Vec3SGrid::Ptr color;
  openvdb::FloatGrid::Ptr part;
};
ColorGrids ColorsBesideSurface(const openvdb::FloatGrid& surface, const ModelVolume& model,
                               const Execution& execution = {});

}  // namespace lascaux

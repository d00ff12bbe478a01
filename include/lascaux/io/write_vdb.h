#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/io/write_vdb_options.h"

/// @file
/// OpenVDB files: level sets and what goes with them as film and games tools take it.

namespace lascaux {

/// Writes a model's grids in millimetres, scaled to the unit (transforms, and the distances and
/// backgrounds of level sets), with statistics metadata and active-mask compression. The first is
/// the level set of the model, which is called "surface" in the file; all others keep their names.
/// They are grids of floats or Vec3f, and no two have the same name.
///
/// A level set's background is the smallest float (of 16 bits, if they are stored) that OpenVDB's
/// checks take for 3 voxels, so a grid that is a level set by tools::checkLevelSet before is one
/// after. The same grids and options give the same bytes: the random id that OpenVDB writes into a
/// file is replaced by one hashed from the content. Holds a copy of the grids and the file's bytes
/// while it works.
///
/// Errors: "cannot-write"; "voxel-too-small": OpenVDB refuses voxels of less than 1.45e-5 units
/// (14.5 micrometres where the unit is a metre); "voxel-too-large": floats of 16 bits end at 65504
/// units, the background is more.
Diagnostics WriteVdb(const std::filesystem::path& path,
                     const std::vector<openvdb::GridBase::ConstPtr>& grids,
                     const WriteVdbOptions& options = {}, const Execution& execution = {});

/// The same for the level set alone.
Diagnostics WriteVdb(const std::filesystem::path& path, const openvdb::FloatGrid& grid,
                     const WriteVdbOptions& options = {}, const Execution& execution = {});

}  // namespace lascaux

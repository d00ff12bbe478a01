#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/io/write_vdb_options.h"

/// @file
/// OpenVDB files: the level set as film and games tools take it.

namespace lascaux {

/// Writes a level set in millimetres as the grid "surface", scaled to the unit (transform,
/// distances and background alike), with statistics metadata and active-mask compression.
///
/// The background is the smallest float that OpenVDB's checks take for 3 voxels, so a grid that is
/// a level set by tools::checkLevelSet before is one after. The same grid and options give the same
/// bytes: the random id that OpenVDB writes into a file is replaced by one hashed from the content.
/// Holds a copy of the grid and the file's bytes while it works.
///
/// Errors: "cannot-write"; "voxel-too-small": OpenVDB refuses voxels of less than 1.45e-5 units
/// (14.5 micrometres where the unit is a metre).
Diagnostics WriteVdb(const std::filesystem::path& path, const openvdb::FloatGrid& grid,
                     const WriteVdbOptions& options = {}, const Execution& execution = {});

}  // namespace lascaux

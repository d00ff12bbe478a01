#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lascaux/base/diagnostic.h"
#include "lascaux/io/units.h"

/// @file
/// Rules of OpenVDB's files that don't need OpenVDB.

namespace lascaux {

/// The smallest float that is at least 3 voxels when divided by the voxel size in double precision:
/// the half width that tools::checkLevelSet asks for.
float VdbBackground(double voxel_size);

/// Replaces a file's random id by one in the same form that is hashed from everything else: from
/// its bytes, or from those at its beginning and the hashes of those behind.
void SetVdbId(std::string& bytes, std::string_view hashes_behind = {});

/// "voxel-too-small" when OpenVDB would refuse voxels of this size in millimetres.
Diagnostics CheckVdbVoxelSize(const std::filesystem::path& path, double voxel_size, Unit unit);

}  // namespace lascaux

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lascaux/io/units.h"
#include "lascaux/volume/up_axis.h"

/// @file
/// How a level set is written, apart from write_vdb.h: without OpenVDB.

namespace lascaux {

/// How floats are stored. Half keeps 11 bits, a distance within 1/2048 of itself: 0.0015 voxel at
/// the band's edge and the less the nearer the surface. Files are 0.6 of the size.
enum class VdbFloats : std::uint8_t { kFull, kHalf };

struct WriteVdbOptions {
  Unit unit = Unit::kMetre;
  UpAxis up = UpAxis::kY;  ///< which the grids have already: "up_axis" says so
  VdbFloats floats = VdbFloats::kFull;
  /// Text metadata of the file, in addition to "units" and "up_axis": creator, version, hash of the
  /// sketch, ...
  std::vector<std::pair<std::string, std::string>> metadata = {};

  bool operator==(const WriteVdbOptions&) const = default;
};

}  // namespace lascaux

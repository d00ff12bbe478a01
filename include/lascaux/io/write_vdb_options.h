#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lascaux/io/units.h"

/// @file
/// How a level set is written, apart from write_vdb.h: without OpenVDB.

namespace lascaux {

struct WriteVdbOptions {
  Unit unit = Unit::kMetre;
  /// Text metadata of the file, in addition to "units" and "up_axis": creator, version, hash of the
  /// sketch, ...
  std::vector<std::pair<std::string, std::string>> metadata = {};

  bool operator==(const WriteVdbOptions&) const = default;
};

}  // namespace lascaux

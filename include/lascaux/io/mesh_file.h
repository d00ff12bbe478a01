#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lascaux/io/units.h"

/// @file
/// What the writers of scene formats have in common.

namespace lascaux {

struct MeshFileOptions {
  Unit unit = Unit::kMetre;     ///< of the coordinates, where the format leaves a choice
  std::string name = "animal";  ///< of the object in the file
  /// Text in the formats that have a place for it: creator, version, hash of the sketch, ...
  std::vector<std::pair<std::string, std::string>> metadata = {};

  bool operator==(const MeshFileOptions&) const = default;
};

}  // namespace lascaux

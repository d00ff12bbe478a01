#pragma once

#include <optional>

#include "lascaux/volume/mesh.h"
#include "lascaux/volume/print_options.h"

namespace lascaux {

/// The plate that a model needs to stand safely; none where it does without.
std::optional<Plate> PlateUnder(const Mesh& mesh, double voxel_size);

}  // namespace lascaux

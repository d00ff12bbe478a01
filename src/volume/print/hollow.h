#pragma once

#include <openvdb/openvdb.h>

#include <optional>

#include "lascaux/volume/print_options.h"

namespace lascaux {

/// Takes a cavity that leaves walls of `wall`, and its drain, out of the level set. Empty, and
/// nothing done, where no place is wide enough for the drain.
std::optional<Cavity> Hollow(openvdb::FloatGrid& grid, double wall);

}  // namespace lascaux

#pragma once

#include "write_outputs.h"

namespace CLI {
class App;
}

namespace lascaux {

/// What a .vdb holds and how, and the unit of the scene formats: --for, --units, --parts, --fog,
/// --color, --half. What is said by itself goes before what --for brings, wherever it stands.
void AddVolume(CLI::App& app, WriteOptions& options);

}  // namespace lascaux

#pragma once

#include "render_command.h"

namespace CLI {
class App;
}

namespace lascaux {

/// The options of `lascaux render`, each bound to the field that it sets.
void AddRender(CLI::App& app, RenderCommandOptions& options, int& threads);

}  // namespace lascaux

#pragma once

#include <filesystem>
#include <vector>

#include "io/image_plugin/image_plugin.h"
#include "lascaux/base/outcome.h"

namespace lascaux {

/// Where the picture plugin may be, best first: relative to the running program (build tree,
/// installed tree), then the folder that the library was configured to be installed to.
std::vector<std::filesystem::path> PluginFolders();

/// The plugin's PNG encoder from the first folder that has it. It is never unloaded. Error:
/// "image-plugin-missing".
Outcome<LascauxEncodePng> LoadPngEncoder(const std::vector<std::filesystem::path>& folders);

}  // namespace lascaux

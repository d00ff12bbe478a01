#pragma once

#include <filesystem>
#include <vector>

#include "io/image_plugin/decode.h"
#include "io/image_plugin/image_plugin.h"
#include "lascaux/base/outcome.h"

namespace lascaux {

/// Where the picture plugin may be, best first: relative to the running program (build tree,
/// installed tree), then the folder that the library was configured to be installed to.
std::vector<std::filesystem::path> PluginFolders();

/// What the plugin can do.
struct ImagePlugin {
  LascauxEncodeExr encode_exr = nullptr;
  LascauxDecode decode = nullptr;
};

/// The plugin from the first folder that has it, whole. It is never unloaded. Error:
/// "image-plugin-missing".
Outcome<ImagePlugin> LoadImagePlugin(const std::vector<std::filesystem::path>& folders);

/// The one that belongs to this program, loaded when it is first asked for.
const Outcome<ImagePlugin>& OurImagePlugin();

}  // namespace lascaux

#include "io/plugin_loader.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>
#include <system_error>

namespace lascaux {
namespace {

constexpr const char* kPluginFile = "lascaux_image.so";

/// False when the library is without this function.
template <typename Function>
bool Find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

}  // namespace

std::vector<std::filesystem::path> PluginFolders() {
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) {
    const auto prefix = program.parent_path().parent_path();
    folders = {prefix / "lib", prefix / "lib/lascaux", prefix / LASCAUX_PLUGIN_SUBFOLDER};
  }
  folders.emplace_back(LASCAUX_PLUGIN_FOLDER);
  return folders;
}

Outcome<ImagePlugin> LoadImagePlugin(const std::vector<std::filesystem::path>& folders) {
  std::string reasons;
  for (const auto& folder : folders) {
    const auto path = folder / kPluginFile;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
      reasons += fmt::format(", not in '{}'", folder.string());
      continue;
    }
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    ImagePlugin plugin;
    if (library != nullptr && Find(library, LASCAUX_ENCODE_EXR, plugin.encode_exr) &&
        Find(library, LASCAUX_DECODE, plugin.decode)) {
      return plugin;
    }
    reasons += fmt::format(", {}", dlerror());
  }
  return Outcome<ImagePlugin>::Failure(Error(
      FailureKind::kOutput, "image-plugin-missing",
      fmt::format("pictures to be read, and .exr, need the plugin {}: {}; install it again with "
                  "the program, or do without "
                  "them",
                  kPluginFile, reasons.empty() ? "no folder to look in" : reasons.substr(2))));
}

const Outcome<ImagePlugin>& OurImagePlugin() {
  static const Outcome<ImagePlugin> plugin = LoadImagePlugin(PluginFolders());
  return plugin;
}

}  // namespace lascaux

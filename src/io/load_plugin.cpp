#include "lascaux/io/load_plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "io/plugin_loader.h"

namespace lascaux {

Outcome<void*> LoadPlugin(const PluginSymbol& wanted) {
  std::string reasons;
  for (const auto& folder : PluginFolders()) {
    const auto path = folder / wanted.file;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
      reasons += fmt::format(", not in '{}'", folder.string());
      continue;
    }
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const symbol = library == nullptr ? nullptr : dlsym(library, wanted.symbol.c_str());
    if (symbol != nullptr) return symbol;
    reasons += fmt::format(", {}", dlerror());
  }
  return Outcome<void*>::Failure(Error(
      FailureKind::kOutput, "plugin-missing",
      fmt::format("a part of the program, {}, cannot be loaded: {}; install it again with "
                  "the program",
                  wanted.file, reasons.empty() ? "no folder to look in" : reasons.substr(2))));
}

}  // namespace lascaux

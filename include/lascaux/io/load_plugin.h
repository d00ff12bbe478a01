#pragma once

#include <string>

#include "lascaux/base/outcome.h"

/// @file
/// Parts of the program that are loaded when they are wanted.

namespace lascaux {

struct PluginSymbol {
  std::string file, symbol;
};

/// The address of a symbol in a plugin, which is looked for beside the running program (../lib,
/// ../lib/lascaux, the installed folder) and never unloaded. May run on any thread.
///
/// Error: "plugin-missing" with the folders that were searched and the system's reasons.
Outcome<void*> LoadPlugin(const PluginSymbol& wanted);

}  // namespace lascaux

#pragma once

#include <string>

namespace lascaux {

inline constexpr const char* kVersion = LASCAUX_VERSION;  // from the root CMakeLists.txt

/// What `lascaux --version` says: the program's version and those of the libraries that it was
/// built with.
std::string VersionText();

}  // namespace lascaux

#pragma once

#include <filesystem>

#include "lascaux/base/diagnostic.h"

namespace lascaux {

/// "cannot-write" with the path, the system's words for `error_number` and what to do about it.
Diagnostic CannotWrite(const std::filesystem::path& path, int error_number);

}  // namespace lascaux

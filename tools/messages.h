#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "lascaux/base/diagnostic.h"

namespace lascaux {

/// What a person who runs the program wants to hear: --quiet silences notes, never warnings and
/// errors.
enum class Verbosity : std::uint8_t { kAll, kQuiet };

/// One line without its end: `file:stroke: warning: code: sentence`; the stroke only where there is
/// one. Line breaks and other control characters of names that come from outside become '?', so
/// that one message is one line.
std::string MessageLine(std::string_view file, const Diagnostic& diagnostic);

/// Writes the lines of all diagnostics to `stream`.
void PrintMessages(std::FILE* stream, std::string_view file, const Diagnostics& diagnostics,
                   Verbosity verbosity);

}  // namespace lascaux

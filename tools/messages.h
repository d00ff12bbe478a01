#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "lascaux/base/diagnostic.h"

namespace lascaux {

/// What a person who runs the program wants to hear: --quiet silences notes, never warnings and
/// errors.
enum class Verbosity : std::uint8_t { kAll, kQuiet };

/// One line without its end: `file:stroke: warning: code: sentence`; the stroke only where there is
/// one. Line breaks and other control characters of names that come from outside become '?', so
/// that one message is one line.
std::string MessageLine(std::string_view file, const Diagnostic& diagnostic);

/// A diagnostic in a list that people read.
struct Listed {
  std::size_t number = 0;  ///< its place among all, from 1
  Diagnostic diagnostic;
};

/// So many notes or warnings of one code are listed; where there are more, the last one says how
/// many it stands for. Errors are always listed.
inline constexpr std::size_t kMostAlike = 4;
std::vector<Listed> ListBriefly(const Diagnostics& diagnostics);

/// Writes the lines of ListBriefly to `stream`.
void PrintMessages(std::FILE* stream, std::string_view file, const Diagnostics& diagnostics,
                   Verbosity verbosity);

}  // namespace lascaux

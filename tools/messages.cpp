#include "messages.h"

#include <fmt/format.h>

#include <algorithm>

namespace lascaux {

std::string MessageLine(std::string_view file, const Diagnostic& diagnostic) {
  std::string line(file);
  if (diagnostic.stroke) line += fmt::format(":{}", *diagnostic.stroke);
  line +=
      fmt::format(": {}: {}: {}", Name(diagnostic.severity), diagnostic.code, diagnostic.message);
  std::replace_if(
      line.begin(), line.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return line;
}

void PrintMessages(std::FILE* stream, std::string_view file, const Diagnostics& diagnostics,
                   Verbosity verbosity) {
  for (const Diagnostic& diagnostic : diagnostics) {
    if (verbosity == Verbosity::kQuiet && diagnostic.severity == Severity::kNote) continue;
    std::fputs((MessageLine(file, diagnostic) + '\n').c_str(), stream);
  }
}

}  // namespace lascaux

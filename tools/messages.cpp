#include "messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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

std::vector<Listed> ListBriefly(const Diagnostics& diagnostics) {
  std::map<std::string_view, std::size_t> all, so_far;
  for (const Diagnostic& d : diagnostics) ++all[d.code];
  std::vector<Listed> list;
  for (std::size_t i = 0; i < diagnostics.size(); ++i) {
    const Diagnostic& d = diagnostics[i];
    const std::size_t count = all[d.code], before = so_far[d.code]++;
    if (d.severity == Severity::kError || count <= kMostAlike || before + 1 < kMostAlike) {
      list.push_back({i + 1, d});
    } else if (before + 1 == kMostAlike) {
      list.push_back({i + 1, d});
      list.back().diagnostic.stroke.reset();
      list.back().diagnostic.message = fmt::format(
          "{} more like this; the report and the picture of `lascaux inspect` have them all",
          count - before);
    }
  }
  return list;
}

void PrintMessages(std::FILE* stream, std::string_view file, const Diagnostics& diagnostics,
                   Verbosity verbosity) {
  for (const Listed& listed : ListBriefly(diagnostics)) {
    if (verbosity == Verbosity::kQuiet && listed.diagnostic.severity == Severity::kNote) continue;
    std::fputs((MessageLine(file, listed.diagnostic) + '\n').c_str(), stream);
  }
}

}  // namespace lascaux

#include "sketch/svg/findings.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "sketch/svg/encoding.h"

namespace lascaux::svg {
namespace {

/// Enough to see what is wrong; nobody reads more.
constexpr int kMaxOfACode = 20;

constexpr std::size_t kMaxQuoted = 60;

}  // namespace

std::string Quoted(std::string_view text) {
  std::string shown(text.substr(0, kMaxQuoted));
  // Cutting may split a character: go back to where one ends.
  while (!shown.empty() && text.size() > kMaxQuoted && !IsUtf8(shown)) shown.pop_back();
  if (!IsUtf8(shown)) shown = Latin1ToUtf8(shown);
  std::replace_if(
      shown.begin(), shown.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }, ' ');
  return fmt::format("'{}{}'", shown, text.size() > kMaxQuoted ? "..." : "");
}

bool Findings::IsWanted(std::string_view code) {
  const auto entry = counts_.find(code);
  if (entry == counts_.end()) {
    counts_.emplace(code, 1);
    return true;
  }
  return ++entry->second <= kMaxOfACode;
}

void Findings::Keep(Diagnostic finding) {
  failed_ = failed_ || finding.severity == Severity::kError;
  kept_.push_back(std::move(finding));
}

Diagnostics Findings::Take() && {
  for (const auto& [code, count] : counts_) {
    if (count <= kMaxOfACode) continue;
    const auto first = std::find_if(kept_.begin(), kept_.end(),
                                    [&code = code](const Diagnostic& d) { return d.code == code; });
    Diagnostic rest = *first;
    rest.message = fmt::format("{} more findings of this kind are not listed", count - kMaxOfACode);
    rest.stroke.reset();
    rest.at.reset();
    kept_.push_back(std::move(rest));
  }
  return std::move(kept_);
}

}  // namespace lascaux::svg

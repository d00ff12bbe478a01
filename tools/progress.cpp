#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

namespace lascaux {
namespace {

bool IsTerminal(std::FILE* stream) {
  if (stream == nullptr) return false;
  const char* term = std::getenv("TERM");
  return isatty(fileno(stream)) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace

ProgressLine::ProgressLine(std::FILE* stream) : stream_(stream), shown_(IsTerminal(stream)) {}

ProgressLine::~ProgressLine() { Clear(); }

std::function<void(std::string_view, double)> ProgressLine::Callback(std::string name) {
  if (!shown_) return {};
  return [this, name = std::move(name)](std::string_view stage, double fraction) {
    std::string line = fmt::format("\r\x1b[K{}: {}", name, stage);
    if (fraction > 0) line += fmt::format(" {:.0f} %", 100 * fraction);
    std::fputs(line.c_str(), stream_);
    std::fflush(stream_);
    dirty_ = true;
  };
}

void ProgressLine::Clear() {
  if (!dirty_) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
  dirty_ = false;
}

}  // namespace lascaux

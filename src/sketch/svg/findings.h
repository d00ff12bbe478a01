#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "lascaux/base/diagnostic.h"

/// @file
/// What a reading has to say, kept short: a file may repeat one mistake a hundred thousand times.

namespace lascaux::svg {

/// Ids and other texts of the file as they stand in a message: in quotes, on one line, not too
/// long, well-formed UTF-8.
std::string Quoted(std::string_view text);

class Findings {
 public:
  /// Adds what `make()` returns, a diagnostic with that code. Of each code only the first few are
  /// kept, and made: to name the place of a finding takes a search through the file.
  template <typename Make>
  void Add(std::string_view code, Make&& make) {
    if (IsWanted(code)) Keep(make());
  }

  /// True once an error has been added: then there is no point in reading on.
  bool failed() const { return failed_; }

  /// All that was kept, in order, with one more entry for each code of which some were not.
  Diagnostics Take() &&;

 private:
  bool IsWanted(std::string_view code);
  void Keep(Diagnostic finding);

  Diagnostics kept_;
  std::map<std::string, int, std::less<>> counts_;
  bool failed_ = false;
};

}  // namespace lascaux::svg

#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <string>
#include <vector>

#include "lascaux/base/outcome.h"

/// @file
/// Outputs that are whole or absent.

namespace lascaux {

/// The outputs of one run: each is written to a temporary file beside its target, all are renamed together by Commit(). The temporary
/// files of a set that is destroyed before are removed.
class OutputSet {
 public:
  OutputSet();
  ~OutputSet();
  OutputSet(OutputSet&&) noexcept;
  OutputSet& operator=(OutputSet&&) noexcept;

  /// A path beside `target` to write to. Errors: "cannot-write" (folder missing, no permission, a folder in the way).
  Outcome<std::filesystem::path> Add(const std::filesystem::path& target);

  /// Renames all to their targets. On an error those that were there before stay as they were.
  Diagnostics Commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes bytes to a file and makes sure that they are on it (short writes, full disks are errors "cannot-write").
Diagnostics WriteBytes(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lascaux

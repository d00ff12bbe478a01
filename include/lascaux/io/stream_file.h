#pragma once

#include <filesystem>

#include "lascaux/base/outcome.h"

/// @file
/// Outputs that go into a pipe, whole or not at all.

namespace lascaux {

/// A file in memory, for writers that want a path, which is sent on when it is complete.
class StreamFile {
 public:
  StreamFile();
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  /// What to write to. Error: "cannot-write", when the system gives no such file.
  Outcome<std::filesystem::path> path() const;

  /// Copies all that was written to a descriptor. Error: "cannot-write"; a program that wants one
  /// for a reader that went away, too, ignores SIGPIPE.
  Diagnostics SendTo(int descriptor) const;

 private:
  int descriptor_ = -1;
  int error_ = 0;
};

}  // namespace lascaux

#pragma once

#include <filesystem>
#include <string_view>

#include "lascaux/base/diagnostic.h"

namespace lascaux {

/// A file that is being written: the first error is kept and everything after it is skipped, so
/// that callers look once.
class FileWriter {
 public:
  /// Creates the file or empties the one that is there.
  explicit FileWriter(std::filesystem::path path);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Hands the bytes to the system at once: callers gather large pieces themselves.
  void Write(std::string_view bytes);

  /// Writes the file's beginning anew: at most as many bytes as it has.
  void Rewrite(std::string_view bytes);

  /// Closes the file; what went wrong since the beginning, if anything did.
  Diagnostics Close();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  int error_ = 0;
};

}  // namespace lascaux

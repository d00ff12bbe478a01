#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "lascaux/base/outcome.h"

/// @file
/// Outputs that are whole or absent.

namespace lascaux {

/// The outputs of one run: each is written to a temporary file, all are renamed together by
/// Commit().
///
/// A set that is destroyed without Commit(), or whose Commit() failed, removes its temporary files,
/// so a program that unwinds on a signal leaves nothing behind. All errors have the code
/// "cannot-write", the path, the system's reason and the remedy. A link at the target stays a link:
/// what it points to is replaced.
class OutputSet {
 public:
  OutputSet();
  ~OutputSet();
  OutputSet(OutputSet&&) noexcept;
  OutputSet& operator=(OutputSet&&) noexcept;

  /// A path to write to: an empty file on the disk of `target` that exists by now, with the rights
  /// of the file that it will replace. On Linux's own file systems it has no name until Commit(),
  /// so that nothing of it is left even when the program is killed; on others it is hidden beside
  /// the target.
  ///
  /// Errors: the folder is missing or may not be written to; a folder, a device or a
  /// write-protected file is in the way; the target is in the set already.
  Outcome<std::filesystem::path> Add(const std::filesystem::path& target);

  /// Renames all to their targets, which empties the set. On an error all targets are as they were
  /// before the call.
  ///
  /// Old files are kept under a second name until the last target is in place. Only a kill in the
  /// middle of the renaming can leave a part of the set replaced.
  Diagnostics Commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a writer found, with the target's name in place of the path that it wrote to.
Diagnostics InNameOf(const std::filesystem::path& target, const std::filesystem::path& written,
                     Diagnostics found);

/// Writes bytes to a file, replacing what was in it, and sees them accepted by the system.
///
/// Short writes, full disks and errors that show on closing are "cannot-write". A program that
/// wants an error at a limit on file sizes, too, ignores SIGXFSZ.
Diagnostics WriteBytes(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lascaux

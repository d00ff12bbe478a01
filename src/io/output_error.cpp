#include "io/output_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace lascaux {
namespace {

std::string Remedy(const std::filesystem::path& path, int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return fmt::format("make the folder '{}' first, or name another",
                         path.parent_path().string());
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to";
    case EISDIR:
      return "a folder has this name: choose another name for the file";
    case EEXIST:
      return "each output needs a name of its own";
    case ENOTSUP:
      return "it is not an ordinary file: choose another name";
    case ENOSPC:
    case EDQUOT:
      return "make room on the disk, or write to another";
    case EFBIG:
      return "raise the limit on file sizes (ulimit -f), or lower the resolution";
    case EPIPE:
      return "whoever reads it stopped before the end";
    case ENAMETOOLONG:
      return "choose a shorter name";
    default:
      return "choose another place";
  }
}

}  // namespace

Diagnostic CannotWrite(const std::filesystem::path& path, int error_number) {
  return Error(
      FailureKind::kOutput, "cannot-write",
      fmt::format("cannot write '{}': {}; {}", path.string(),
                  std::generic_category().message(error_number), Remedy(path, error_number)));
}

}  // namespace lascaux

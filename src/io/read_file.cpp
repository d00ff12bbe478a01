#include "lascaux/io/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace lascaux {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;  // bytes asked for at once from a pipe

Diagnostic CannotRead(const std::filesystem::path& path, const std::string& reason) {
  const std::string name = path == "-" ? "standard input" : fmt::format("'{}'", path.string());
  return Error(FailureKind::kInput, "cannot-read", fmt::format("cannot read {}: {}", name, reason));
}

Diagnostic CannotRead(const std::filesystem::path& path, int error_number) {
  std::string reason = std::generic_category().message(error_number);
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      reason += "; check the name";
      break;
    case EISDIR:
      reason += "; name a file inside it";
      break;
    case EACCES:
    case EPERM:
      reason += "; make it readable for you";
      break;
    default:
      break;
  }
  return CannotRead(path, reason);
}

/// Owns a descriptor that was opened here, and borrows standard input.
struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number > STDIN_FILENO) close(number);
  }
};

Diagnostic TooLarge(const std::filesystem::path& path, std::size_t max_bytes) {
  return CannotRead(
      path, fmt::format("it is larger than {} bytes; give a file within this limit", max_bytes));
}

}  // namespace

Outcome<std::string> ReadBytes(const std::filesystem::path& path, const ReadBytesOptions& options) {
  using Result = Outcome<std::string>;
  const Descriptor file{path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) return Result::Failure(CannotRead(path, errno));
  struct stat status;
  if (fstat(file.number, &status) != 0) return Result::Failure(CannotRead(path, errno));
  const bool sized = S_ISREG(status.st_mode) && status.st_size > 0;
  const std::size_t expected = sized ? static_cast<std::size_t>(status.st_size) : 0;
  if (expected > options.max_bytes) return Result::Failure(TooLarge(path, options.max_bytes));

  // One byte more than expected, so that a file of the announced size ends with the second call.
  std::string bytes;
  std::size_t size = 0;
  for (;;) {
    if (size == bytes.size()) bytes.resize(std::max({expected + 1, size + kPiece, 2 * size}));
    const ssize_t count = read(file.number, bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return Result::Failure(CannotRead(path, errno));
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
    if (size > options.max_bytes) return Result::Failure(TooLarge(path, options.max_bytes));
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace lascaux

#include "lascaux/io/stream_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>

#include "io/output_error.h"

namespace lascaux {
namespace {

Diagnostic CannotSend(int error) { return CannotWrite("standard output", error); }

/// Writes all of it; an error number, 0 for done.
int WriteAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(descriptor, bytes.data(), bytes.size());
    if (count >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

}  // namespace

StreamFile::StreamFile() : descriptor_(memfd_create("lascaux", MFD_CLOEXEC)) {
  if (descriptor_ < 0) error_ = errno;
}

StreamFile::~StreamFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

Outcome<std::filesystem::path> StreamFile::path() const {
  if (descriptor_ < 0) return Outcome<std::filesystem::path>::Failure(CannotSend(error_));
  return std::filesystem::path("/proc/self/fd/" + std::to_string(descriptor_));
}

Diagnostics StreamFile::SendTo(int descriptor) const {
  std::array<char, std::size_t{1} << 16> piece;  // as much as a pipe holds
  off_t from = 0;
  for (;;) {
    const ssize_t count = pread(descriptor_, piece.data(), piece.size(), from);
    if (count == 0) return {};
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return {CannotSend(errno)};
    const int error = WriteAll(descriptor, {piece.data(), static_cast<std::size_t>(count)});
    if (error != 0) return {CannotSend(error)};
    from += count;
  }
}

}  // namespace lascaux

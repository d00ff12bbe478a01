#include "io/file_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "io/output_error.h"
#include "lascaux/io/output_file.h"

namespace lascaux {

FileWriter::FileWriter(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) error_ = errno;
}

FileWriter::~FileWriter() {
  if (descriptor_ >= 0) close(descriptor_);
}

void FileWriter::Write(std::string_view bytes) {
  while (error_ == 0 && !bytes.empty()) {
    const ssize_t count = write(descriptor_, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      error_ = errno;
    }
  }
}

void FileWriter::Rewrite(std::string_view bytes) {
  if (error_ == 0 && lseek(descriptor_, 0, SEEK_SET) < 0) error_ = errno;
  Write(bytes);
}

Diagnostics FileWriter::Close() {
  // Some file systems report a full disk only here. EINTR on closing means closed on Linux.
  if (descriptor_ >= 0 && close(descriptor_) != 0 && error_ == 0 && errno != EINTR) error_ = errno;
  descriptor_ = -1;
  if (error_ != 0) return {CannotWrite(path_, error_)};
  return {};
}

Diagnostics WriteBytes(const std::filesystem::path& path, std::string_view bytes) {
  FileWriter file(path);
  file.Write(bytes);
  return file.Close();
}

}  // namespace lascaux

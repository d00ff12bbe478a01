#include "io/zip_writer.h"

#include <minizip/zip.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace lascaux {
namespace {

/// Seven eighths of the best compression of coordinates in a quarter of its time.
constexpr int kLevel = 3;

constexpr std::size_t kMostBytes = std::numeric_limits<std::uint32_t>::max();

}  // namespace

/// The archive's "file": the writer's own string.
struct ZipWriter::Callbacks {
  static voidpf Open(voidpf self, const void*, int) { return self; }
  static uLong Read(voidpf, voidpf self, void* to, uLong size) {
    auto& zip = *static_cast<ZipWriter*>(self);
    const std::size_t count = std::min<std::size_t>(size, zip.bytes_.size() - zip.position_);
    std::copy_n(zip.bytes_.data() + zip.position_, count, static_cast<char*>(to));
    zip.position_ += count;
    return static_cast<uLong>(count);
  }
  static uLong Write(voidpf, voidpf self, const void* from, uLong size) {
    auto& zip = *static_cast<ZipWriter*>(self);
    zip.bytes_.resize(std::max<std::size_t>(zip.bytes_.size(), zip.position_ + size));
    std::copy_n(static_cast<const char*>(from), size, zip.bytes_.data() + zip.position_);
    zip.position_ += size;
    return size;
  }
  static ZPOS64_T Tell(voidpf, voidpf self) { return static_cast<ZipWriter*>(self)->position_; }
  static long Seek(voidpf, voidpf self, ZPOS64_T offset, int origin) {
    auto& zip = *static_cast<ZipWriter*>(self);
    const std::size_t from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? zip.position_
                             : origin == ZLIB_FILEFUNC_SEEK_END ? zip.bytes_.size()
                                                                : 0;
    if (from + offset > zip.bytes_.size()) return -1;
    zip.position_ = from + offset;
    return 0;
  }
  static int Close(voidpf, voidpf) { return 0; }
  static int Error(voidpf, voidpf) { return 0; }
};

ZipWriter::ZipWriter() {
  zlib_filefunc64_def functions{};
  functions.zopen64_file = Callbacks::Open;
  functions.zread_file = Callbacks::Read;
  functions.zwrite_file = Callbacks::Write;
  functions.ztell64_file = Callbacks::Tell;
  functions.zseek64_file = Callbacks::Seek;
  functions.zclose_file = Callbacks::Close;
  functions.zerror_file = Callbacks::Error;
  functions.opaque = this;
  archive_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  good_ = archive_ != nullptr;
}

ZipWriter::~ZipWriter() {
  if (archive_ != nullptr) zipClose(archive_, nullptr);
}

void ZipWriter::Add(const std::string& name, std::string_view content) {
  zip_fileinfo info{};
  info.dosDate = (1 << 5) | 1;  // 1980-01-01
  good_ = good_ && content.size() <= kMostBytes &&
          zipOpenNewFileInZip(archive_, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                              Z_DEFLATED, kLevel) == ZIP_OK &&
          zipWriteInFileInZip(archive_, content.data(), static_cast<unsigned>(content.size())) ==
              ZIP_OK &&
          zipCloseFileInZip(archive_) == ZIP_OK;
}

std::optional<std::string> ZipWriter::Finish() {
  good_ = good_ && zipClose(std::exchange(archive_, nullptr), nullptr) == ZIP_OK &&
          bytes_.size() <= kMostBytes;
  if (!good_) return std::nullopt;
  return std::move(bytes_);
}

}  // namespace lascaux

#include "io/mesh_readers/unzip.h"

#include <minizip/unzip.h>

#include <algorithm>
#include <memory>

namespace lascaux {
namespace {

/// An archive in memory as minizip's "file".
struct MemoryFile {
  std::string_view bytes;
  std::size_t position = 0;

  static voidpf Open(voidpf self, const void*, int) { return self; }
  static uLong Read(voidpf, voidpf self, void* to, uLong size) {
    auto& file = *static_cast<MemoryFile*>(self);
    const std::size_t count = std::min<std::size_t>(size, file.bytes.size() - file.position);
    std::copy_n(file.bytes.data() + file.position, count, static_cast<char*>(to));
    file.position += count;
    return static_cast<uLong>(count);
  }
  static uLong Write(voidpf, voidpf, const void*, uLong) { return 0; }
  static ZPOS64_T Tell(voidpf, voidpf self) { return static_cast<MemoryFile*>(self)->position; }
  static long Seek(voidpf, voidpf self, ZPOS64_T offset, int origin) {
    auto& file = *static_cast<MemoryFile*>(self);
    const std::size_t from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? file.position
                             : origin == ZLIB_FILEFUNC_SEEK_END ? file.bytes.size()
                                                                : 0;
    if (offset > file.bytes.size() - from) return -1;
    file.position = from + offset;
    return 0;
  }
  static int Close(voidpf, voidpf) { return 0; }
  static int Error(voidpf, voidpf) { return 0; }
};

struct CloseArchive {
  void operator()(void* archive) const { unzClose(archive); }
};

}  // namespace

std::optional<std::string> Unzip(std::string_view archive, const std::string& name,
                                 std::size_t max_bytes) {
  constexpr int kIgnoreCase = 2;
  constexpr std::size_t kPiece = std::size_t{1} << 18;
  MemoryFile file{archive};
  zlib_filefunc64_def functions{
      MemoryFile::Open, MemoryFile::Read,  MemoryFile::Write, MemoryFile::Tell,
      MemoryFile::Seek, MemoryFile::Close, MemoryFile::Error, &file};
  const std::unique_ptr<void, CloseArchive> zip(unzOpen2_64("", &functions));
  if (!zip || unzLocateFile(zip.get(), name.c_str(), kIgnoreCase) != UNZ_OK ||
      unzOpenCurrentFile(zip.get()) != UNZ_OK)
    return std::nullopt;
  std::string content;
  for (;;) {
    const std::size_t size = content.size();
    content.resize(size + kPiece);
    const int count = unzReadCurrentFile(zip.get(), content.data() + size, kPiece);
    content.resize(size + static_cast<std::size_t>(std::max(count, 0)));
    if (count < 0 || content.size() > max_bytes) return std::nullopt;
    if (count == 0) break;
  }
  if (unzCloseCurrentFile(zip.get()) != UNZ_OK) return std::nullopt;
  return content;
}

}  // namespace lascaux

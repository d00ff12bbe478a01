#include "sketch/svg/gzip.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

namespace lascaux::svg {
namespace {

/// zlib's window for any stream, and the flag that asks for the gzip format.
constexpr int kAnyWindow = 15, kGzip = 16;

class Inflater {
 public:
  Inflater() : ready_(inflateInit2(&stream_, kAnyWindow + kGzip) == Z_OK) {}
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  bool ready() const { return ready_; }
  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
  bool ready_;
};

}  // namespace

bool IsGzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

Outcome<std::string> Unzip(std::string_view bytes, std::size_t most) {
  const auto failure = [](const char* code, std::string message) {
    return Outcome<std::string>::Failure(Error(FailureKind::kInput, code, std::move(message)));
  };
  Inflater inflater;
  if (!inflater.ready() || bytes.size() > std::numeric_limits<uInt>::max())
    return failure("too-large", "there is no memory to unpack the file");
  z_stream& stream = inflater.stream();
  // zlib takes no const pointer, but leaves the input alone.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  std::array<char, 1 << 15> block;
  while (true) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    text.append(block.data(), block.size() - stream.avail_out);
    if (text.size() > most) {
      return failure("too-large",
                     fmt::format("the compressed file unpacks to more than the {} bytes that are "
                                 "read; remove embedded pictures and metadata, or raise the limit",
                                 most));
    }
    if (status == Z_STREAM_END) {
      const std::string_view rest = bytes.substr(bytes.size() - stream.avail_in);
      if (!IsGzip(rest)) return text;  // whatever follows the last member is padding
      inflateReset(&stream);
    } else if (status != Z_OK) {
      return failure("broken-xml",
                     fmt::format("the compressed file is damaged or cut off at byte {}; save it "
                                 "again",
                                 bytes.size() - stream.avail_in));
    }
  }
}

}  // namespace lascaux::svg

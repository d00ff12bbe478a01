#include "lascaux/io/write_png.h"

#include <fmt/format.h>
#include <png.h>

#include <cassert>
#include <csetjmp>
#include <utility>

#include "lascaux/io/output_file.h"

namespace lascaux {
namespace {

struct Encoding {
  std::string bytes, error;
};

void Append(png_structp png, png_bytep bytes, png_size_t size) {
  auto* const encoding = static_cast<Encoding*>(png_get_io_ptr(png));
  encoding->bytes.append(reinterpret_cast<const char*>(bytes), size);
}

void Flush(png_structp) {}

[[noreturn]] void Fail(png_structp png, png_const_charp message) {
  static_cast<Encoding*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void Warn(png_structp, png_const_charp) {}

/// False when the error says why. Nothing with a destructor lives in here: libpng jumps out.
bool Encode(const Image& image, Encoding* encoding) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, encoding, Fail, Warn);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, encoding, Append, Flush);
  const auto width = static_cast<png_uint_32>(image.width);
  png_set_IHDR(png, info, width, static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGBA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  // Trying all filters and harder compression take three times as long, for a tenth of the bytes.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(png, 4);
  png_write_info(png, info);
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row)
    png_write_row(png, image.rgba.data() + 4 * width * row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

Outcome<std::string> EncodePng(const std::filesystem::path& path, const Image& image) {
  assert(image.width > 0 && image.height > 0);
  assert(image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                  static_cast<std::size_t>(image.height));
  using Result = Outcome<std::string>;
  Encoding encoding;
  if (!Encode(image, &encoding)) {
    return Result::Failure(Error(FailureKind::kOutput, "cannot-write",
                                 fmt::format("cannot write '{}': {}; ask for a smaller picture",
                                             path.string(), encoding.error)));
  }
  return std::move(encoding.bytes);
}

Diagnostics WritePng(const std::filesystem::path& path, const Image& image) {
  const Outcome<std::string> bytes = EncodePng(path, image);
  return bytes ? WriteBytes(path, *bytes) : bytes.diagnostics();
}

}  // namespace lascaux

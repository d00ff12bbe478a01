#include "lascaux/io/read_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "io/image_plugin/decode.h"
#include "io/plugin_loader.h"

namespace lascaux {
namespace {

using namespace std::string_view_literals;

constexpr std::array kBeginnings = {
    "\x89PNG"sv,          "\xff\xd8\xff"sv, "II*\0"sv,      "MM\0*"sv,        "GIF8"sv,
    "\x76\x2f\x31\x01"sv, "8BPS"sv,         "#?RADIANCE"sv, "\0\0\0\x0cjP"sv, "\xff\x4f\xff\x51"sv};

/// What the plugin's callbacks fill.
struct Decoding {
  Bitmap picture;
  std::string reason;
};

std::uint8_t* MakeCanvas(void* context, std::int32_t width, std::int32_t height) {
  Bitmap& picture = static_cast<Decoding*>(context)->picture;
  picture.width = width;
  picture.height = height;
  picture.rgba.resize(std::size_t{4} * static_cast<std::size_t>(width) *
                      static_cast<std::size_t>(height));
  return picture.rgba.data();
}

void AppendReason(void* context, const char* bytes, std::size_t size) {
  static_cast<Decoding*>(context)->reason.append(bytes, size);
}

/// Libraries that decode JPEG fill what is missing with grey and call it good, and libpng writes a
/// message of its own.
bool EndsTooEarly(std::string_view bytes) {
  constexpr std::size_t kTrailer = 1024;  // some writers append a few bytes
  const std::string_view tail = bytes.substr(bytes.size() - std::min(bytes.size(), kTrailer));
  if (bytes.starts_with("\xff\xd8\xff"sv)) return tail.rfind("\xff\xd9"sv) == tail.npos;
  if (bytes.starts_with("\x89PNG"sv)) return tail.rfind("IEND"sv) == tail.npos;
  return false;
}

Diagnostic BrokenPicture(std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return Error(FailureKind::kInput, "broken-picture",
               fmt::format("the picture can't be read: {}; save it again as PNG",
                           reason.empty() ? "OpenImageIO gives no reason" : reason));
}

/// Without the plugin it is the input that can't be read, not an output that can't be written.
Diagnostics AsInput(Diagnostics diagnostics) {
  for (Diagnostic& d : diagnostics)
    if (d.failure == FailureKind::kOutput) d.failure = FailureKind::kInput;
  return diagnostics;
}

}  // namespace

bool IsPicture(std::string_view bytes) noexcept {
  if (bytes.size() < 12) return false;
  if (bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
      (bytes[2] == '\n' || bytes[2] == ' '))
    return true;
  if (bytes.starts_with("RIFF"sv)) return bytes.substr(8, 4) == "WEBP"sv;
  if (bytes.starts_with("BM"sv)) return bytes.substr(6, 4) == "\0\0\0\0"sv;
  return std::any_of(kBeginnings.begin(), kBeginnings.end(),
                     [&](std::string_view beginning) { return bytes.starts_with(beginning); });
}

Outcome<Bitmap> ReadPicture(std::string_view bytes, const ReadPictureOptions& options) {
  using Result = Outcome<Bitmap>;
  if (EndsTooEarly(bytes)) return Result::Failure(BrokenPicture("it ends too early"));
  const Outcome<ImagePlugin>& plugin = OurImagePlugin();
  if (!plugin) return Result::Failure(AsInput(plugin.diagnostics()));
  const LascauxEncoded file{bytes.data(), bytes.size(), options.max_pixels};
  Decoding decoding;
  switch (plugin->decode(&file, MakeCanvas, AppendReason, &decoding)) {
    case 0:
      return std::move(decoding.picture);
    case 2:
      return Result::Failure(
          Error(FailureKind::kInput, "too-large",
                fmt::format("the picture has {} pixels, more than {}; make it smaller",
                            decoding.reason, options.max_pixels)));
    default:
      return Result::Failure(BrokenPicture(std::move(decoding.reason)));
  }
}

}  // namespace lascaux

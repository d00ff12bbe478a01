#pragma once

#include <cstdint>
#include <string_view>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/bitmap.h"

namespace lascaux {

struct ReadPictureOptions {
  std::int64_t max_pixels = 40'000'000;

  bool operator==(const ReadPictureOptions&) const = default;
};

/// Whether bytes begin like a file that holds a picture, in one of the usual formats: PNG, JPEG,
/// TIFF, BMP, WebP, GIF, PNM, OpenEXR, PSD, JPEG 2000, HDR, TGA excepted (it has no beginning of
/// its own).
bool IsPicture(std::string_view bytes) noexcept;

/// Decodes a picture: anything that OpenImageIO reads, turned upright as its Exif data say, with 8
/// bits a channel. OpenImageIO is loaded when this is called first, which takes 0.15 s.
///
/// Errors (input): "broken-picture", also for one that ends too early; "too-large", before it costs
/// memory; "image-plugin-missing".
Outcome<Bitmap> ReadPicture(std::string_view bytes, const ReadPictureOptions& options = {});

}  // namespace lascaux

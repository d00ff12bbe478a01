#pragma once

#include <filesystem>
#include <string>

#include "lascaux/base/outcome.h"
#include "lascaux/volume/image.h"

/// @file
/// PNG pictures.

namespace lascaux {

/// Writes the picture as PNG: 8 bits a channel, sRGB, straight alpha; no time stamp.
///
/// libpng does it, and not OpenImageIO, which takes 0.15 s to load.
///
/// Error: "cannot-write" with the encoder's own reason. An image without pixels is a broken
/// precondition.
Diagnostics WritePng(const std::filesystem::path& path, const Image& image);

/// The same bytes, to be put into another file: `path` is the one that errors name.
Outcome<std::string> EncodePng(const std::filesystem::path& path, const Image& image);

}  // namespace lascaux

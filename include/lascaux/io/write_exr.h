#pragma once

#include <filesystem>

#include "lascaux/base/outcome.h"
#include "lascaux/volume/picture.h"

/// @file
/// OpenEXR pictures.

namespace lascaux {

/// Writes the picture and its layers as OpenEXR, ZIP compressed, always with the same date in it.
///
/// Channels: R G B A (half; linear, sRGB primaries, associated alpha); Z (float; along the camera's
/// axis in the grid's world units, 1e10 where nothing is seen); N.X N.Y N.Z (half; world axes);
/// part (float; -1 where there is none). Layers that the picture is without are left out.
///
/// Errors: those of WritePng(). A picture without pixels is a broken precondition.
Diagnostics WriteExr(const std::filesystem::path& path, const Picture& picture);

}  // namespace lascaux

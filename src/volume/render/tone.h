#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "volume/render/light.h"

namespace lascaux {

/// The backdrop's light at a place of the picture, from -1 to 1 along its longer side, y down:
/// paper that darkens a little towards the corners.
Color Backdrop(float x, float y);

/// A shadow on the backdrop, 0 to 1: what is left is a little warmer than grey.
Color Shadowed(const Color& backdrop, float shadow);

/// Takes light from the model to what paper can show: linear for dark and middle tones, bright ones
/// roll off below 1.
Color ToneMapped(const Color& light);

/// Linear light, clamped to 0 to 1, as 8-bit sRGB.
std::array<std::uint8_t, 3> Encode(const Color& light);

}  // namespace lascaux

#pragma once

#include <Eigen/Core>

#include "volume/render/light.h"

namespace lascaux {

/// The studio's backdrop at a place of the picture, from -1 to 1 along its longer side, y down:
/// paper that darkens a little towards the corners.
Color Paper(float x, float y);

/// A shadow on the backdrop, 0 to 1: what is left is a little warmer than grey.
Color Shadowed(const Color& backdrop, float shadow);
/// The same shadow without a backdrop: black that covers a part of what it is laid on.
Light ShadowAlone(float shadow);

inline Light Opaque(const Color& color) { return {color[0], color[1], color[2], 1}; }

/// Takes light from the model to what paper can show: linear for dark and middle tones, bright ones
/// roll off below 1.
Color ToneMapped(const Color& light);

}  // namespace lascaux

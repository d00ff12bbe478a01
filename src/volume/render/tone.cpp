#include "volume/render/tone.h"

#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

const Color kPaperMiddle(0.86F, 0.845F, 0.82F);
const Color kCorner(0.65F, 0.63F, 0.60F);
const Color kShadowTint(0.10F, 0.085F, 0.08F);  // light that every shadow keeps

constexpr float kShoulder = 0.55F;  // where bright tones begin to roll off

}  // namespace

Color Paper(float x, float y) {
  const float r = std::min(1.F, 0.55F * (x * x + (y + 0.1F) * (y + 0.1F)));
  return kPaperMiddle + r * (kCorner - kPaperMiddle);
}

Color Shadowed(const Color& backdrop, float shadow) {
  return backdrop * (1 - shadow * (1 - kShadowTint));
}

Light ShadowAlone(float shadow) { return {0, 0, 0, shadow * (1 - kShadowTint.mean())}; }

Color ToneMapped(const Color& light) {
  // Tangent to the straight line at the shoulder, and 1 only for infinite light.
  const Color over = (light - kShoulder).max(0.F);
  constexpr float kRoom = 1 - kShoulder;
  return light.min(kShoulder) + kRoom * over / (over + kRoom);
}

}  // namespace lascaux

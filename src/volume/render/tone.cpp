#include "volume/render/tone.h"

#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

const Color kPaper(0.905F, 0.893F, 0.872F);
const Color kCorner(0.745F, 0.728F, 0.700F);
const Color kShadowTint(0.10F, 0.085F, 0.08F);  // light that every shadow keeps

constexpr float kShoulder = 0.55F;  // where bright tones begin to roll off
constexpr int kLevels = 4096;

std::array<std::uint8_t, kLevels + 1> MakeCurve() {
  std::array<std::uint8_t, kLevels + 1> curve;
  for (std::size_t i = 0; i <= kLevels; ++i) {
    const double c = static_cast<double>(i) / kLevels;
    const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    curve[i] = static_cast<std::uint8_t>(std::lround(255 * s));
  }
  return curve;
}

}  // namespace

Color Backdrop(float x, float y) {
  const float r = std::min(1.F, 0.55F * (x * x + (y + 0.1F) * (y + 0.1F)));
  return kPaper + r * (kCorner - kPaper);
}

Color Shadowed(const Color& backdrop, float shadow) {
  return backdrop * (1 - shadow * (1 - kShadowTint));
}

Color ToneMapped(const Color& light) {
  // Tangent to the straight line at the shoulder, and 1 only for infinite light.
  const Color over = (light - kShoulder).max(0.F);
  constexpr float kRoom = 1 - kShoulder;
  return light.min(kShoulder) + kRoom * over / (over + kRoom);
}

std::array<std::uint8_t, 3> Encode(const Color& light) {
  static const auto kCurve = MakeCurve();
  std::array<std::uint8_t, 3> bytes;
  for (std::size_t i = 0; i < 3; ++i) {
    const float level = std::clamp(light[static_cast<int>(i)], 0.F, 1.F) * kLevels;
    bytes[i] = kCurve[static_cast<std::size_t>(level + 0.5F)];
  }
  return bytes;
}

}  // namespace lascaux

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lascaux/base/srgb.h"
#include "lascaux/volume/picture.h"

namespace lascaux {
namespace {

constexpr int kLevels = 4096;
using Curve = std::array<float, kLevels + 2>;

/// Levels of sRGB, 0 to 255, of linear light in steps of 1 / kLevels.
Curve MakeCurve() {
  Curve curve;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double c = std::min(1.0, static_cast<double>(i) / kLevels);
    curve[i] = static_cast<float>(255 * EncodeSrgb(c));
  }
  return curve;
}

float ToLevels(const Curve& curve, float light) {
  const float at = std::clamp(light, 0.F, 1.F) * kLevels;
  const auto i = static_cast<std::size_t>(static_cast<int>(at));
  return curve[i] + (at - static_cast<float>(i)) * (curve[i + 1] - curve[i]);
}

/// Thresholds between 0 and 1 in Bayer's order: neighbours differ as much as they can.
constexpr int kPattern = 8;
constexpr std::array<std::array<float, kPattern>, kPattern> MakePattern() {
  std::array<std::array<float, kPattern>, kPattern> pattern = {};
  for (unsigned y = 0; y < kPattern; ++y) {
    for (unsigned x = 0; x < kPattern; ++x) {
      unsigned rank = 0;
      for (unsigned bit = 0; bit < 3; ++bit) {
        const unsigned row = y >> bit & 1U, column = x >> bit & 1U;
        rank |= ((row ^ column) << 1U | row) << (4 - 2 * bit);
      }
      pattern[y][x] = (static_cast<float>(rank) + 0.5F) / (kPattern * kPattern);
    }
  }
  return pattern;
}
constexpr auto kThresholds = MakePattern();

/// Rounds up where the rest is above the threshold. What is all but a whole level stays it, so that
/// black, white and plain colours are clean.
std::uint8_t Round(float levels, float threshold) {
  constexpr float kWhole = 1.F / 64;
  return static_cast<std::uint8_t>(
      static_cast<int>(levels + std::clamp(threshold, kWhole, 1 - kWhole)));
}

}  // namespace

Image ToImage(const Picture& picture) {
  static const Curve kCurve = MakeCurve();
  Image image{picture.width, picture.height, std::vector<std::uint8_t>(picture.rgba.size())};
  const float* from = picture.rgba.data();
  std::uint8_t* to = image.rgba.data();
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
    const auto& thresholds = kThresholds[y % kPattern];
    for (std::size_t x = 0; x < static_cast<std::size_t>(picture.width); ++x, from += 4, to += 4) {
      const float threshold = thresholds[x % kPattern];
      const float alpha = std::clamp(from[3], 0.F, 1.F);
      const float straight = alpha == 1 ? 1 : alpha > 0 ? 1 / alpha : 0;
      for (int i = 0; i < 3; ++i) to[i] = Round(ToLevels(kCurve, straight * from[i]), threshold);
      to[3] = Round(255 * alpha, threshold);
    }
  }
  return image;
}

}  // namespace lascaux

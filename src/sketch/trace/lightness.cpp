#include "sketch/trace/lightness.h"

#include <algorithm>

namespace lascaux::trace {

Tone LightnessOf(const Bitmap& picture, int reduction) {
  const int width = (picture.width + reduction - 1) / reduction;
  const int height = (picture.height + reduction - 1) / reduction;
  Tone tone(width, height);
  std::vector<std::int64_t> sum(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    std::fill(sum.begin(), sum.end(), 0);
    const int y0 = y * reduction, y1 = std::min(y0 + reduction, picture.height);
    for (int v = y0; v < y1; ++v) {
      const std::uint8_t* p = picture.rgba.data() + 4 * static_cast<std::size_t>(v) *
                                                        static_cast<std::size_t>(picture.width);
      int left = reduction;
      std::size_t x = 0;
      for (int u = 0; u < picture.width; ++u, p += 4) {
        // Rec. 709's weights, in parts of 256; alpha as 255ths of it over white.
        const int luma = 54 * p[0] + 183 * p[1] + 19 * p[2];
        sum[x] += std::int64_t{luma} * p[3] + std::int64_t{256 * 255} * (255 - p[3]);
        if (--left == 0) left = reduction, ++x;
      }
    }
    for (int x = 0; x < width; ++x) {
      const int count = (std::min((x + 1) * reduction, picture.width) - x * reduction) * (y1 - y0);
      tone(x, y) = static_cast<float>(static_cast<double>(sum[static_cast<std::size_t>(x)]) /
                                      (256.0 * 255 * 255 * count));
    }
  }
  return tone;
}

Tone Enlarged(const Tone& tone, int factor) {
  if (factor <= 1) return tone;
  Tone result(tone.width * factor, tone.height * factor);
  for (int y = 0; y < result.height; ++y) {
    const double v = std::clamp((y + 0.5) / factor - 0.5, 0.0, tone.height - 1.0);
    const int y0 = static_cast<int>(v), y1 = std::min(y0 + 1, tone.height - 1);
    for (int x = 0; x < result.width; ++x) {
      const double u = std::clamp((x + 0.5) / factor - 0.5, 0.0, tone.width - 1.0);
      const int x0 = static_cast<int>(u), x1 = std::min(x0 + 1, tone.width - 1);
      const double fx = u - x0, fy = v - y0;
      result(x, y) = static_cast<float>((1 - fy) * ((1 - fx) * tone(x0, y0) + fx * tone(x1, y0)) +
                                        fy * ((1 - fx) * tone(x0, y1) + fx * tone(x1, y1)));
    }
  }
  return result;
}

bool IsDarkPage(const Tone& lightness) {
  const int w = lightness.width, h = lightness.height;
  std::int64_t dark = 0, all = 0;
  const auto look = [&](int x, int y) {
    ++all;
    dark += lightness(x, y) < 0.35f ? 1 : 0;
  };
  for (int x = 0; x < w; ++x) look(x, 0), look(x, h - 1);
  for (int y = 0; y < h; ++y) look(0, y), look(w - 1, y);
  return 2 * dark > all;
}

}  // namespace lascaux::trace

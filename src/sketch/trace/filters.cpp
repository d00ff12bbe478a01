#include "sketch/trace/filters.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lascaux::trace {
namespace {

/// Rows become columns, in tiles that stay in the cache.
Tone Transposed(const Tone& tone) {
  constexpr int kTile = 32;
  Tone result(tone.height, tone.width);
  for (int y0 = 0; y0 < tone.height; y0 += kTile)
    for (int x0 = 0; x0 < tone.width; x0 += kTile)
      for (int y = y0; y < std::min(y0 + kTile, tone.height); ++y)
        for (int x = x0; x < std::min(x0 + kTile, tone.width); ++x) result(y, x) = tone(x, y);
  return result;
}

/// Greatest (by Better) of 2 radius + 1 rows around each, by the method of van Herk and of Gil and
/// Werman: running extremes from both ends of each block of that many rows, whole rows at a time.
template <typename Better>
Tone ExtremeOfRows(const Tone& tone, int radius, Better better) {
  const int width = tone.width, height = tone.height, window = 2 * radius + 1;
  const auto combine = [&](const float* a, const float* b, float* to) {
    for (int x = 0; x < width; ++x) to[x] = better(a[x], b[x]) ? a[x] : b[x];
  };
  Tone forward = tone, backward = tone;
  for (int y = 1; y < height; ++y)
    if (y % window != 0) combine(forward.Row(y), forward.Row(y - 1), forward.Row(y));
  for (int y = height - 2; y >= 0; --y)
    if ((y + 1) % window != 0) combine(backward.Row(y), backward.Row(y + 1), backward.Row(y));
  Tone result(width, height);
  for (int y = 0; y < height; ++y) {
    const int first = std::max(y - radius, 0), last = std::min(y + radius, height - 1);
    if (first / window != last / window) {
      combine(backward.Row(first), forward.Row(last), result.Row(y));
    } else {  // a whole block, or what the picture's edge leaves of a window
      const Tone& running = first % window == 0 ? forward : backward;
      std::copy_n(running.Row(first % window == 0 ? last : first), width, result.Row(y));
    }
  }
  return result;
}

template <typename Better>
Tone Extreme(const Tone& tone, int radius, Better better) {
  if (radius <= 0 || tone.data.empty()) return tone;
  const Tone columns = Transposed(ExtremeOfRows(tone, radius, better));
  return Transposed(ExtremeOfRows(columns, radius, better));
}

/// Mean over 2 radius + 1 rows around each. The running sum is kept in double: it would drift.
Tone MeanOfRows(const Tone& tone, int radius) {
  const int width = tone.width, height = tone.height;
  const auto row = [&](int y) { return tone.Row(std::clamp(y, 0, height - 1)); };
  std::vector<double> sum(static_cast<std::size_t>(width), 0.0);
  for (int y = -radius; y <= radius; ++y)
    for (int x = 0; x < width; ++x) sum[static_cast<std::size_t>(x)] += row(y)[x];
  Tone result(width, height);
  const double share = 1.0 / (2 * radius + 1);
  for (int y = 0; y < height; ++y) {
    const float *entering = row(y + radius + 1), *leaving = row(y - radius);
    float* to = result.Row(y);
    for (int x = 0; x < width; ++x) {
      double& s = sum[static_cast<std::size_t>(x)];
      to[x] = static_cast<float>(s * share);
      s += static_cast<double>(entering[x]) - static_cast<double>(leaving[x]);
    }
  }
  return result;
}

}  // namespace

Tone Blurred(const Tone& tone, double sigma) {
  // Three boxes of half-width r have the variance r (r + 1).
  const int radius = static_cast<int>(std::lround(std::sqrt(sigma * sigma + 0.25) - 0.5));
  if (radius <= 0 || tone.data.empty()) return tone;
  Tone columns = tone;
  for (int i = 0; i < 3; ++i) columns = MeanOfRows(columns, radius);
  Tone rows = Transposed(columns);
  for (int i = 0; i < 3; ++i) rows = MeanOfRows(rows, radius);
  return Transposed(rows);
}

Tone Dilated(const Tone& tone, int radius) { return Extreme(tone, radius, std::greater<>()); }

Tone Eroded(const Tone& tone, int radius) { return Extreme(tone, radius, std::less<>()); }

Tone Closed(const Tone& tone, int radius) { return Eroded(Dilated(tone, radius), radius); }

Tone Reduced(const Tone& tone, int factor) {
  if (factor <= 1) return tone;
  Tone result((tone.width + factor - 1) / factor, (tone.height + factor - 1) / factor);
  for (int y = 0; y < result.height; ++y) {
    const int y1 = std::min((y + 1) * factor, tone.height);
    for (int x = 0; x < result.width; ++x) {
      const int x1 = std::min((x + 1) * factor, tone.width);
      float sum = 0;
      for (int v = y * factor; v < y1; ++v)
        for (int u = x * factor; u < x1; ++u) sum += tone(u, v);
      result(x, y) = sum / static_cast<float>((y1 - y * factor) * (x1 - x * factor));
    }
  }
  return result;
}

}  // namespace lascaux::trace

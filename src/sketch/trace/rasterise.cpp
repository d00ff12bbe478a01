#include "sketch/trace/rasterise.h"

#include <algorithm>
#include <cmath>

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;

constexpr int kHeights = 4;     // sampled in each pixel
constexpr double kFlat = 0.05;  // pixels that flattened curves may be off

struct Crossing {
  double x;
  int direction;
};

/// Crossings of each sampled height with the contours.
class Heights {
 public:
  explicit Heights(int rows) : crossings_(static_cast<std::size_t>(rows * kHeights)) {}

  void AddLine(const Vector2d& a, const Vector2d& b) {
    if (a.y() == b.y()) return;
    const Vector2d &top = a.y() < b.y() ? a : b, &bottom = a.y() < b.y() ? b : a;
    // Height k is at (k + 0.5) / kHeights.
    const double last = static_cast<double>(crossings_.size()) - 1;
    const double from = std::max(0.0, std::ceil(top.y() * kHeights - 0.5));
    const double to = std::min(last, std::ceil(bottom.y() * kHeights - 0.5) - 1);
    const double slope = (bottom.x() - top.x()) / (bottom.y() - top.y());
    for (double k = from; k <= to; ++k) {
      const double y = (k + 0.5) / kHeights;
      crossings_[static_cast<std::size_t>(k)].push_back(
          {top.x() + slope * (y - top.y()), a.y() < b.y() ? 1 : -1});
    }
  }

  std::vector<Crossing>& At(int row, int k) {
    return crossings_[static_cast<std::size_t>(row * kHeights + k)];
  }

 private:
  std::vector<std::vector<Crossing>> crossings_;
};

void FillSpan(double from, double to, float* row, int width) {
  from = std::clamp(from, 0.0, static_cast<double>(width));
  to = std::clamp(to, 0.0, static_cast<double>(width));
  for (int x = static_cast<int>(from); x < width && x < to; ++x)
    row[x] += static_cast<float>((std::min(to, x + 1.0) - std::max(from, static_cast<double>(x))) /
                                 kHeights);
}

}  // namespace

Tone Rasterised(const Contours& contours, FillRule rule, const RasterFrame& frame) {
  Heights heights(frame.height);
  for (const auto& contour : contours) {
    if (contour.empty()) continue;
    const auto map = [&](const Vector2d& p) -> Vector2d {
      return (p - frame.origin) / frame.scale;
    };
    for (const CubicBezier& curve : contour) {
      const auto samples = Flatten(curve, kFlat * frame.scale);
      for (std::size_t i = 1; i < samples.size(); ++i)
        heights.AddLine(map(samples[i - 1].point), map(samples[i].point));
    }
    heights.AddLine(map(contour.back().p[3]), map(contour.front().p[0]));
  }
  Tone tone(frame.width, frame.height);
  for (int y = 0; y < frame.height; ++y)
    for (int k = 0; k < kHeights; ++k) {
      auto& crossings = heights.At(y, k);
      std::sort(crossings.begin(), crossings.end(),
                [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
      int winding = 0;
      for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        winding += crossings[i].direction;
        const bool inside = rule == FillRule::kNonZero ? winding != 0 : i % 2 == 0;
        if (inside) FillSpan(crossings[i].x, crossings[i + 1].x, tone.Row(y), frame.width);
      }
    }
  return tone;
}

}  // namespace lascaux::trace

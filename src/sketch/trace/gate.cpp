#include "sketch/trace/gate.h"

#include <algorithm>
#include <cmath>

#include "sketch/trace/regions.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;

void Stamp(const Vector2d& center, double radius, Mask& mask) {
  const int y0 = std::max(0, static_cast<int>(std::floor(center.y() - radius)));
  const int y1 = std::min(mask.height - 1, static_cast<int>(std::floor(center.y() + radius)));
  for (int y = y0; y <= y1; ++y) {
    const double dy = y + 0.5 - center.y(),
                 half = std::sqrt(std::max(0.0, radius * radius - dy * dy));
    const int x0 = std::max(0, static_cast<int>(std::ceil(center.x() - half - 0.5)));
    const int x1 = std::min(mask.width - 1, static_cast<int>(std::floor(center.x() + half - 0.5)));
    for (int x = x0; x <= x1; ++x) mask(x, y) = 1;
  }
}

/// Draws a stroke; `more` pixels are added to the pen's radius.
void Draw(const Stroke& stroke, const Ink& ink, double more, Mask& mask) {
  const auto dab = [&](const Vector2d& at) {
    const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
    // Up to the nearest pixel that is no ink; where a curve left the ink, the pen's own width.
    const bool inside = mask.Holds(x, y) && ink.mask(x, y);
    const double radius =
        inside ? std::sqrt(static_cast<double>(ink.squared(x, y))) : 0.5 * stroke.width;
    Stamp(at, radius + more, mask);
  };
  for (const CubicBezier& piece : stroke.pieces) {
    const auto samples = Flatten(piece, 0.1);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Vector2d a = samples[i - 1].point, b = samples[i].point;
      const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm())));
      for (int k = 0; k <= steps; ++k) dab(a + (b - a) * (static_cast<double>(k) / steps));
    }
  }
}

struct Regions {
  int ink = 0, curves = 0;
};

/// Regions of the page of at least `least` pixels: those that the ink makes; and those that the
/// curves make, among which the first in each of the ink's counts however small it is.
Regions CountBoth(const Mask& ink, const Mask& drawn, double least) {
  const auto is_large = [&](const Region& r) { return static_cast<double>(r.size()) >= least; };
  Plane<std::int32_t> owner(ink.width, ink.height, -1);
  Regions count;
  for (const Region& region : RegionsOf(ink, 0, Neighbours::kEdges)) {
    if (!is_large(region)) continue;
    for (const std::int32_t i : region) owner.data[static_cast<std::size_t>(i)] = count.ink;
    ++count.ink;
  }
  std::vector<bool> has_one(static_cast<std::size_t>(count.ink));
  std::vector<Region> regions = RegionsOf(drawn, 0, Neighbours::kEdges);
  std::stable_sort(regions.begin(), regions.end(),
                   [](const Region& a, const Region& b) { return a.size() > b.size(); });
  for (const Region& region : regions) {
    bool first = false;
    for (const std::int32_t i : region) {
      const int id = owner.data[static_cast<std::size_t>(i)];
      if (id < 0 || has_one[static_cast<std::size_t>(id)]) continue;
      first = true;
      has_one[static_cast<std::size_t>(id)] = true;
      break;
    }
    if (first || is_large(region)) ++count.curves;
  }
  return count;
}

}  // namespace

GateFacts Compare(const std::vector<Stroke>& strokes, const Ink& ink) {
  Mask drawn(ink.mask.width, ink.mask.height);
  for (const Stroke& stroke : strokes) Draw(stroke, ink, 0, drawn);
  GateFacts facts;
  const Regions regions = CountBoth(ink.mask, drawn, ink.width * ink.width);
  facts.ink_regions = regions.ink;
  facts.curve_regions = regions.curves;
  // Half a pixel more: the rim of the ink is where rounding to pixels decides.
  for (const Stroke& stroke : strokes) Draw(stroke, ink, 0.5, drawn);
  Mask missed(ink.mask.width, ink.mask.height);
  std::size_t all = 0, misses = 0;
  for (std::size_t i = 0; i < drawn.data.size(); ++i) {
    all += ink.mask.data[i];
    missed.data[i] = ink.mask.data[i] && !drawn.data[i] ? 1 : 0;
    misses += missed.data[i];
  }
  if (all > 0) facts.coverage = 1 - static_cast<double>(misses) / static_cast<double>(all);
  std::size_t largest = 0;
  for (const Region& region : RegionsOf(missed, 1, Neighbours::kCorners)) {
    if (region.size() <= largest) continue;
    largest = region.size();
    Vector2d sum = Vector2d::Zero();
    for (const std::int32_t i : region)
      sum += Vector2d(i % drawn.width + 0.5, i / drawn.width + 0.5);
    facts.worst = sum / static_cast<double>(region.size());
  }
  return facts;
}

}  // namespace lascaux::trace

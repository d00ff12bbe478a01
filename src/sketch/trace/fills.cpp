#include "sketch/trace/fills.h"

#include <algorithm>
#include <cmath>

#include "sketch/trace/distance.h"
#include "sketch/trace/regions.h"

namespace lascaux::trace {
namespace {

constexpr double kThick = 1.1;  // widths: half of what a fill is thick at least
constexpr double kBrush = 2.0;  // widths: half of what a brush's stroke is thick at most
constexpr double kLong = 3.0;   // a brush's stroke is this many times as long as thick

/// Whether the thick core of a dark area is that of a fill.
bool IsFill(const Region& core, const Plane<std::int32_t>& squared, double width) {
  double thickest = 0;
  int x0 = squared.width, x1 = 0, y0 = squared.height, y1 = 0;
  for (const std::int32_t i : core) {
    thickest = std::max(thickest, HalfWidth(squared.data[static_cast<std::size_t>(i)]));
    const int x = i % squared.width, y = i / squared.width;
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  const double length = std::hypot(x1 - x0, y1 - y0) + 2 * kThick * width;
  return thickest > kBrush * width || length < kLong * 2 * thickest;
}

}  // namespace

Fills FillsOf(const Mask& dark, double width) {
  const int w = dark.width, h = dark.height;
  const Plane<std::int32_t> squared = SquaredDistances(dark);
  const double thick = kThick * width;
  Mask core(w, h);
  std::size_t all = 0;
  for (std::size_t i = 0; i < core.data.size(); ++i) {
    core.data[i] = HalfWidth(squared.data[i]) > thick ? 1 : 0;
    all += dark.data[i];
  }
  Fills fills{Mask(w, h), Mask(w, h), 0};
  Mask far(w, h);  // all but the cores of fills: its distances are those to them
  for (int y = 1; y + 1 < h; ++y) std::fill_n(far.Row(y) + 1, std::max(0, w - 2), std::uint8_t{1});
  bool any = false;
  for (const Region& region : RegionsOf(core, 1, Neighbours::kCorners)) {
    if (!IsFill(region, squared, width)) continue;
    any = true;
    for (const std::int32_t i : region) far.data[static_cast<std::size_t>(i)] = 0;
  }
  if (!any) return fills;
  const Plane<std::int32_t> to_core = SquaredDistances(far);
  std::size_t filled = 0;
  for (int y = 1; y + 1 < h; ++y) {
    for (int x = 1; x + 1 < w; ++x) {
      const std::size_t i = dark.Index(x, y);
      const bool at_edge =
          x <= thick + 1 || y <= thick + 1 || x + thick + 2 >= w || y + thick + 2 >= h;
      if (!dark.data[i] || (far.data[i] && (at_edge || HalfWidth(to_core.data[i]) > thick + 1)))
        continue;
      fills.area.data[i] = 1;
      fills.interior.data[i] = HalfWidth(squared.data[i]) > width ? 1 : 0;
      ++filled;
    }
  }
  fills.share = static_cast<double>(filled) / static_cast<double>(std::max<std::size_t>(1, all));
  return fills;
}

}  // namespace lascaux::trace

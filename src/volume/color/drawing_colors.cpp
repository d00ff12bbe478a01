#include "lascaux/volume/drawing_colors.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lascaux/base/arena.h"
#include "volume/color/side_view.h"
#include "volume/render/distance_transform.h"

namespace lascaux {
namespace {

using Eigen::Array3f;

/// A drawing has colours if at least this share of what is seen has one. A colour has a
/// component below kFaintest, or it is white, and one above kInk, or it is ink.
constexpr double kLeastColored = 0.05;
constexpr int kFaintest = 230, kInk = 76;  // 8-bit sRGB

bool IsColored(const Array3f& linear) {
  const int low = SrgbFromLinear(linear.minCoeff()), high = SrgbFromLinear(linear.maxCoeff());
  return low < kFaintest && high > kInk;
}

Srgb8 MedianOf(std::vector<Array3f> colors) {
  Srgb8 median{};
  if (colors.empty()) return median;
  const auto middle = colors.begin() + static_cast<std::ptrdiff_t>(colors.size() / 2);
  for (int k = 0; k < 3; ++k) {
    std::nth_element(colors.begin(), middle, colors.end(),
                     [k](const Array3f& a, const Array3f& b) { return a[k] < b[k]; });
    median[static_cast<std::size_t>(k)] = SrgbFromLinear((*middle)[k]);
  }
  return median;
}

/// The pixels of `box` in which `layer` is what is seen: those whose colours are known, or all, if
/// none is: an eye may be all ink.
std::vector<bool> ShownPixels(std::uint16_t layer, const PageColors& page, const SideView& view) {
  const Eigen::AlignedBox2i& box = view.boxes[layer];
  std::vector<bool> all, known;
  bool any = false;
  for (int y = box.min().y(); y <= box.max().y(); ++y) {
    for (int x = box.min().x(); x <= box.max().x(); ++x) {
      const std::size_t p = page.Index(x, y);
      all.push_back(view.layers[p] == layer);
      known.push_back(all.back() && page.known[p]);
      any = any || known.back();
    }
  }
  return any ? known : all;
}

/// A layer whose pixels are the page's where they show `layer`, else the nearest of these; empty
/// when no pixel does.
ColorLayer LayerOf(std::uint16_t layer, const PageColors& page, const SideView& view) {
  const Eigen::AlignedBox2i& box = view.boxes[layer];
  if (box.isEmpty()) return {};
  ColorLayer result{box.min().x(), box.min().y(), box.sizes().x() + 1, box.sizes().y() + 1, {}, {}};
  const auto place = [&](int x, int y) { return page.Index(result.left + x, result.top + y); };
  const std::size_t count =
      static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
  NearestSeeds seeds{std::vector<float>(count, kNoSeed), std::vector<float>(count, 0.F)};
  std::vector<Array3f> seen;
  const std::vector<bool> shown = ShownPixels(layer, page, view);
  std::size_t i = 0;
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x, ++i) {
      if (!shown[i]) continue;
      seeds.squared_distance[i] = 0;
      seeds.value[i] = static_cast<float>(i);  // exact: below 2^24
      seen.push_back(page.colors[place(x, y)]);
    }
  }
  if (seen.empty()) return {};
  seeds = SpreadSeeds(std::move(seeds), {result.width, result.height, 1});
  result.colors.reserve(count);
  for (const float value : seeds.value) {
    const auto seed = static_cast<int>(value);
    result.colors.push_back(page.colors[place(seed % result.width, seed / result.width)]);
  }
  result.color = MedianOf(std::move(seen));
  return result;
}

bool HasColors(const PageColors& page, const SideView& view) {
  std::size_t seen = 0, colored = 0;
  for (std::size_t i = 0; i < view.layers.size(); ++i) {
    if (view.layers[i] == kNoLayer || !page.known[i]) continue;
    ++seen;
    colored += IsColored(page.colors[i]) ? 1 : 0;
  }
  return static_cast<double>(colored) > kLeastColored * static_cast<double>(seen);
}

}  // namespace

Array3f DrawingColors::At(std::size_t part, float x, float y) const noexcept {
  const ColorLayer& layer = layers[layer_of_part[part]];
  const Eigen::Vector2d p =
      (frame.ToSketch(Eigen::Vector2d(x, y)) - origin) / pixel - Eigen::Vector2d::Constant(0.5);
  const auto clamped = [](double v, int low, int size) {
    return static_cast<float>(std::clamp(v - low, 0.0, size - 1.0));
  };
  const float u = clamped(p.x(), layer.left, layer.width);
  const float v = clamped(p.y(), layer.top, layer.height);
  const int x0 = static_cast<int>(u), y0 = static_cast<int>(v);
  const int x1 = std::min(x0 + 1, layer.width - 1), y1 = std::min(y0 + 1, layer.height - 1);
  const float fx = u - static_cast<float>(x0), fy = v - static_cast<float>(y0);
  const auto at = [&layer](int column, int row) -> const Array3f& {
    return layer.colors[static_cast<std::size_t>(row) * static_cast<std::size_t>(layer.width) +
                        static_cast<std::size_t>(column)];
  };
  return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x1, y0)) +
         fy * ((1 - fx) * at(x0, y1) + fx * at(x1, y1));
}

std::optional<DrawingColors> ProjectColors(const PageColors& page, const ColoredView& view,
                                           const Execution& execution) {
  const SideView side = SeenFromTheSide(page, view);
  if (!HasColors(page, side)) return std::nullopt;
  DrawingColors result{view.frame, page.origin, page.pixel, {}, view.layer_of_part};
  result.layers.resize(side.boxes.size());
  RunInArena(execution, [&] {
    tbb::parallel_for(std::size_t{0}, result.layers.size(), [&](std::size_t i) {
      result.layers[i] = LayerOf(static_cast<std::uint16_t>(i), page, side);
    });
  });
  // What nobody sees has the body's colour, which is the first's.
  const auto first = std::find_if(result.layers.begin(), result.layers.end(),
                                  [](const ColorLayer& layer) { return !layer.colors.empty(); });
  if (first == result.layers.end()) return std::nullopt;
  for (ColorLayer& layer : result.layers) {
    if (layer.colors.empty())
      layer = {0,
               0,
               1,
               1,
               {Array3f(LinearFromSrgb(first->color[0]), LinearFromSrgb(first->color[1]),
                        LinearFromSrgb(first->color[2]))},
               first->color};
  }
  return result;
}

}  // namespace lascaux

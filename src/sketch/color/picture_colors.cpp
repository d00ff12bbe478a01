#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lascaux/base/srgb.h"
#include "lascaux/sketch/page_colors.h"
#include "sketch/color/page_raster.h"
#include "sketch/trace/lightness.h"
#include "sketch/trace/regions.h"

namespace lascaux {
namespace {

using Eigen::Array3f;
using Eigen::Vector2d;

/// Lines are wider than they were traced by this share of a pen and this many pixels: their edges
/// are mixed with ink.
constexpr double kWider = 0.25, kPixelsWider = 1;
/// A page's brightness is fitted to at least this share of the raster.
constexpr double kLeastPage = 0.01;
/// Tone of the darkest page that colours are read on; log of 0 is none.
constexpr float kLeastTone = 0.02F;

std::array<float, 256> LinearTones() {
  std::array<float, 256> tones;
  for (std::size_t i = 0; i < tones.size(); ++i)
    tones[i] = static_cast<float>(DecodeSrgb(static_cast<double>(i) / 255));
  return tones;
}

/// The mean of the picture's pixels in each of the page's, over white paper.
void TakeColors(const Bitmap& picture, PageColors& page) {
  const std::array<float, 256> tones = LinearTones();
  std::vector<float> count(page.colors.size(), 0.F);
  std::fill(page.colors.begin(), page.colors.end(), Array3f::Zero());
  const std::uint8_t* p = picture.rgba.data();
  for (int v = 0; v < picture.height; ++v) {
    const int y = static_cast<int>(std::floor((v + 0.5 - page.origin.y()) / page.pixel));
    for (int u = 0; u < picture.width; ++u, p += 4) {
      const int x = static_cast<int>(std::floor((u + 0.5 - page.origin.x()) / page.pixel));
      if (x < 0 || y < 0 || x >= page.width || y >= page.height) continue;
      const float alpha = static_cast<float>(p[3]) / 255;
      const std::size_t i = page.Index(x, y);
      page.colors[i] += alpha * Array3f(tones[p[0]], tones[p[1]], tones[p[2]]) + (1 - alpha);
      count[i] += 1;
    }
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] > 0) {
      page.colors[i] /= count[i];
    } else {
      page.known[i] = 0;
    }
  }
}

/// The pixels from which the raster's edge is reached without crossing a line.
std::vector<std::uint8_t> Outside(const PageColors& page, const trace::Mask& lines) {
  std::vector<std::uint8_t> outside(page.colors.size(), 0);
  for (const trace::Region& region : trace::RegionsOf(lines, 0, trace::Neighbours::kEdges)) {
    const bool at_edge = std::any_of(region.begin(), region.end(), [&](std::int32_t i) {
      const int x = i % page.width, y = i / page.width;
      return x == 0 || y == 0 || x == page.width - 1 || y == page.height - 1;
    });
    if (!at_edge) continue;
    for (const std::int32_t i : region) outside[static_cast<std::size_t>(i)] = 1;
  }
  return outside;
}

/// Divides by the colour of the paper and its light: the logarithm of each component is a linear
/// function of the place, fitted outside of the drawing.
void MakePageWhite(const std::vector<std::uint8_t>& outside, PageColors& page) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(), right = Eigen::Matrix3d::Zero();
  const auto place = [&page](int x, int y) {
    return Eigen::Vector3d(1, static_cast<double>(x) / page.width,
                           static_cast<double>(y) / page.height);
  };
  const auto for_each = [&page](auto&& use) {
    for (int y = 0; y < page.height; ++y)
      for (int x = 0; x < page.width; ++x) use(x, y, page.Index(x, y));
  };
  double count = 0;
  for_each([&](int x, int y, std::size_t i) {
    if (!outside[i] || !page.known[i]) return;
    const Eigen::Vector3d at = place(x, y);
    normal += at * at.transpose();
    right += at * page.colors[i].max(kLeastTone).log().matrix().transpose().cast<double>();
    ++count;
  });
  if (count < kLeastPage * static_cast<double>(page.colors.size())) return;
  const Eigen::Matrix3d fit = normal.ldlt().solve(right);
  for_each([&](int x, int y, std::size_t i) {
    const Eigen::Vector3d paper = fit.transpose() * place(x, y);
    page.colors[i] = (page.colors[i] / paper.array().exp().cast<float>()).min(1.F);
  });
}

}  // namespace

std::optional<PageColors> ColorsOf(const Bitmap& picture, const Sketch& traced, int longest) {
  if (traced.strokes.empty() || !(Bounds(traced).sizes().maxCoeff() > 0)) return std::nullopt;
  if (trace::IsDarkPage(trace::LightnessOf(picture, std::max(1, picture.width / 512))))
    return std::nullopt;
  PageColors page = color::WhitePage(traced, longest);
  TakeColors(picture, page);
  trace::Mask lines(page.width, page.height);
  for (const Stroke& stroke : traced.strokes) {
    const double reach = (0.5 + kWider) * stroke.width + kPixelsWider * std::max(1.0, page.pixel);
    color::ForPixelsNear(stroke, reach, page, [&](std::size_t i) {
      lines.data[i] = 1;
      page.known[i] = 0;
    });
  }
  MakePageWhite(Outside(page, lines), page);
  return page;
}

}  // namespace lascaux

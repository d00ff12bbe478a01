#include <algorithm>
#include <cmath>

#include "lascaux/base/srgb.h"
#include "lascaux/sketch/page_colors.h"
#include "sketch/color/page_raster.h"
#include "sketch/trace/distance.h"
#include "sketch/trace/rasterise.h"

namespace lascaux {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Array3f;
using Eigen::Vector2d;

/// How far from an area the unpainted page is taken for the area's: a share of the diagonal.
constexpr double kBeside = 0.015;
/// How much of a pixel is painted when its colour is the areas' alone.
constexpr float kPainted = 0.99F;

float ToLinear(double encoded) { return static_cast<float>(DecodeSrgb(encoded)); }

/// The page while areas are painted on it.
class Painting {
 public:
  explicit Painting(PageColors page) : page_(std::move(page)), painted_(page_.colors.size(), 0.F) {}

  void Paint(const FilledArea& area) {
    AlignedBox2d box;
    for (const auto& outline : area.outlines)
      for (const CubicBezier& piece : outline) box.extend(Bounds(piece));
    const Vector2d low = (box.min() - page_.origin) / page_.pixel;
    const Vector2d high = (box.max() - page_.origin) / page_.pixel;
    const int x0 = std::max(0, static_cast<int>(low.x()));
    const int y0 = std::max(0, static_cast<int>(low.y()));
    const int x1 = std::min(page_.width, static_cast<int>(high.x()) + 1);
    const int y1 = std::min(page_.height, static_cast<int>(high.y()) + 1);
    if (x1 <= x0 || y1 <= y0) return;
    const trace::RasterFrame own{page_.origin + page_.pixel * Vector2d(x0, y0), page_.pixel,
                                 x1 - x0, y1 - y0};
    const trace::Tone share = trace::Rasterised(area.outlines, area.rule, own);
    const Array3f color(ToLinear(area.color[0]), ToLinear(area.color[1]), ToLinear(area.color[2]));
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const float s = std::min(1.F, share(x - x0, y - y0));
        const std::size_t i = page_.Index(x, y);
        page_.colors[i] += s * (color - page_.colors[i]);
        painted_[i] += s * (1 - painted_[i]);
      }
    }
  }

  PageColors Finish(double beside) && {
    trace::Mask bare(page_.width, page_.height);
    for (int y = 1; y + 1 < page_.height; ++y)  // masks end before the edge
      for (int x = 1; x + 1 < page_.width; ++x)
        bare(x, y) = painted_[page_.Index(x, y)] < kPainted ? 1 : 0;
    const auto squared = trace::SquaredDistances(bare);
    const double limit = std::pow(beside / page_.pixel, 2);
    for (std::size_t i = 0; i < painted_.size(); ++i) {
      page_.known[i] = bare.data[i] == 0 || squared.data[i] > limit ? 1 : 0;
      if (bare.data[i] != 0) page_.colors[i] = Array3f::Ones();
    }
    return std::move(page_);
  }

 private:
  PageColors page_;
  std::vector<float> painted_;  ///< share of each pixel
};

}  // namespace

std::optional<PageColors> ColorsOf(const Sketch& sketch, int longest) {
  const AlignedBox2d box = Bounds(sketch);
  if (sketch.areas.empty() || !(box.sizes().maxCoeff() > 0)) return std::nullopt;
  Painting painting(color::WhitePage(sketch, longest));
  for (const FilledArea& area : sketch.areas) painting.Paint(area);
  return std::move(painting).Finish(kBeside * box.diagonal().norm());
}

}  // namespace lascaux

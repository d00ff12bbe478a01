#pragma once

#include <algorithm>

#include "lascaux/sketch/page_colors.h"

namespace lascaux::color {

/// White and known everywhere, over all strokes and areas, with a margin of a pixel.
PageColors WhitePage(const Sketch& sketch, int longest);

/// Calls `use(index)` for each pixel whose middle is within `reach` (sketch units) of a stroke.
template <typename Use>
void ForPixelsNear(const Stroke& stroke, double reach, const PageColors& page, Use&& use) {
  for (const CubicBezier& piece : stroke.pieces) {
    const auto samples = Flatten(piece, 0.25 * page.pixel);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Eigen::Vector2d a = samples[i - 1].point, d = samples[i].point - a;
      const Eigen::Vector2d low = a.cwiseMin(a + d).array() - reach - page.origin.array();
      const Eigen::Vector2d high = a.cwiseMax(a + d).array() + reach - page.origin.array();
      const int x0 = std::max(0, static_cast<int>(low.x() / page.pixel));
      const int y0 = std::max(0, static_cast<int>(low.y() / page.pixel));
      const int x1 = std::min(page.width - 1, static_cast<int>(high.x() / page.pixel));
      const int y1 = std::min(page.height - 1, static_cast<int>(high.y() / page.pixel));
      for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
          const Eigen::Vector2d p =
              page.origin + page.pixel * Eigen::Vector2d(x + 0.5, y + 0.5) - a;
          const double along = d.squaredNorm();
          const double t = along > 0 ? std::clamp(p.dot(d) / along, 0.0, 1.0) : 0;
          if ((p - t * d).squaredNorm() <= reach * reach) use(page.Index(x, y));
        }
      }
    }
  }
}

}  // namespace lascaux::color

#include "sketch/color/page_raster.h"

#include <algorithm>
#include <cmath>

namespace lascaux::color {

PageColors WhitePage(const Sketch& sketch, int longest) {
  constexpr int kMargin = 1;
  const Eigen::AlignedBox2d box = Bounds(sketch);
  PageColors page;
  page.pixel = box.sizes().maxCoeff() / std::max(1, longest - 2 * kMargin);
  page.origin = box.min() - Eigen::Vector2d::Constant(kMargin * page.pixel);
  page.width = static_cast<int>(std::ceil(box.sizes().x() / page.pixel)) + 2 * kMargin;
  page.height = static_cast<int>(std::ceil(box.sizes().y() / page.pixel)) + 2 * kMargin;
  const std::size_t count = page.Index(page.width - 1, page.height - 1) + 1;
  page.colors.assign(count, Eigen::Array3f::Ones());
  page.known.assign(count, 1);
  return page;
}

}  // namespace lascaux::color

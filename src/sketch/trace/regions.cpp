#include "sketch/trace/regions.h"

namespace lascaux::trace {

std::vector<Region> RegionsOf(const Mask& mask, std::uint8_t value, Neighbours neighbours) {
  std::vector<Region> regions;
  Mask seen(mask.width, mask.height);
  const int step = neighbours == Neighbours::kEdges ? 2 : 1;
  for (std::size_t first = 0; first < mask.data.size(); ++first) {
    if (mask.data[first] != value || seen.data[first]) continue;
    Region region{static_cast<std::int32_t>(first)};
    seen.data[first] = 1;
    for (std::size_t n = 0; n < region.size(); ++n) {
      const int x = region[n] % mask.width, y = region[n] / mask.width;
      for (int k = 0; k < 8; k += step) {
        const int u = x + kDx[k], v = y + kDy[k];
        if (!mask.Holds(u, v) || mask(u, v) != value || seen(u, v)) continue;
        seen(u, v) = 1;
        region.push_back(v * mask.width + u);
      }
    }
    regions.push_back(std::move(region));
  }
  return regions;
}

}  // namespace lascaux::trace

#include "volume/edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace lascaux {

EdgeTable::EdgeTable(const Mesh& mesh) : first_(mesh.vertices.size() + 1, 0) {
  const auto for_sides = [&mesh](auto&& visit) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& corners = mesh.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners[k], b = corners[k == 2 ? 0 : k + 1];
        if (a != b) visit(std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(3 * t + k));
      }
    }
  };
  // A counting sort by the smaller vertex: there are few sides at each, so sorting those is cheap.
  for_sides([this](std::uint32_t low, std::uint32_t, std::uint32_t) { ++first_[low + 1]; });
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  sides_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for_sides([&](std::uint32_t low, std::uint32_t high, std::uint32_t side) {
    sides_[next[low]++] = {high, side};
  });
  tbb::parallel_for(std::size_t{0}, vertices(), [this](std::size_t v) {
    std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(first_[v]),
              sides_.begin() + static_cast<std::ptrdiff_t>(first_[v + 1]),
              [](const EdgeSide& a, const EdgeSide& b) {
                return a.high != b.high ? a.high < b.high : a.side < b.side;
              });
  });
}

}  // namespace lascaux

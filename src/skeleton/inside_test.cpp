#include "skeleton/inside_test.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace lascaux {
namespace {

/// Calls visit(edge, row) for the rows of each edge.
template <typename RowOf, typename Visit>
void ForRows(const Ring& ring, const RowOf& row_of, const Visit& visit) {
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const auto [low, high] = std::minmax({row_of(ring[i].y()), row_of(ring[j].y())});
    for (std::size_t row = low; row <= high; ++row) visit(i, row);
  }
}

}  // namespace

InsideTest::InsideTest(const Ring& ring) : ring_(ring), first_(ring.size() + 1, 0) {
  if (ring.empty()) return;
  double high = -std::numeric_limits<double>::infinity();
  low_ = -high;
  for (const Eigen::Vector2d& p : ring) {
    low_ = std::min(low_, p.y());
    high = std::max(high, p.y());
  }
  const auto rows = static_cast<double>(ring.size());
  per_row_ = high > low_ ? rows / (high - low_) : 0;
  const auto row_of = [this](double y) { return RowOf(y); };
  ForRows(ring, row_of, [this](std::size_t, std::size_t row) { ++first_[row + 1]; });
  for (std::size_t row = 0; row < ring.size(); ++row) first_[row + 1] += first_[row];
  edges_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  ForRows(ring, row_of, [&](std::size_t edge, std::size_t row) {
    edges_[next[row]++] = static_cast<std::uint32_t>(edge);
  });
}

/// Rises with y, so that a point between an edge's ends is in one of its rows.
std::size_t InsideTest::RowOf(double y) const {
  const double row = (y - low_) * per_row_, last = static_cast<double>(ring_.size() - 1);
  return row > 0 ? static_cast<std::size_t>(std::min(row, last)) : 0;
}

bool InsideTest::Contains(const Eigen::Vector2d& point) const {
  bool inside = false;
  if (ring_.empty()) return inside;
  const std::size_t row = RowOf(point.y());
  for (std::uint32_t k = first_[row]; k < first_[row + 1]; ++k) {
    const std::size_t i = edges_[k];
    const Eigen::Vector2d &a = ring_[i], &b = ring_[i > 0 ? i - 1 : ring_.size() - 1];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

}  // namespace lascaux

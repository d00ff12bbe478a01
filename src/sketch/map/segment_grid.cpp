#include "sketch/map/segment_grid.h"

#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

/// At most so many cells along a side: 512 x 512 cells are 1 MB.
constexpr double kMaxCellsPerSide = 512;
/// At most so many cells a segment, or emptying them takes longer than the search.
constexpr double kMaxCellsPerSegment = 8;
/// Where more than this share of all numbers is listed, marking them is faster than sorting.
constexpr double kManyShare = 0.1;

/// The numbers below `count` that are listed, each once.
std::vector<int> Ascending(std::vector<int> listed, std::size_t count) {
  if (static_cast<double>(listed.size()) < kManyShare * static_cast<double>(count)) {
    std::sort(listed.begin(), listed.end());
    listed.erase(std::unique(listed.begin(), listed.end()), listed.end());
    return listed;
  }
  std::vector<char> is_listed(count, 0);
  for (const int i : listed) is_listed[static_cast<std::size_t>(i)] = 1;
  listed.clear();
  for (std::size_t i = 0; i < count; ++i) {
    if (is_listed[i]) listed.push_back(static_cast<int>(i));
  }
  return listed;
}

}  // namespace

SegmentGrid::SegmentGrid(std::vector<SegmentRef> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  double length = 0;
  for (const SegmentRef& s : segments_) {
    bounds_.extend(s.a);
    bounds_.extend(s.b);
    length += (s.b - s.a).norm();
  }
  const double side = bounds_.sizes().maxCoeff();
  const auto count = static_cast<double>(segments_.size());
  const double cells_per_side = std::min(kMaxCellsPerSide, std::sqrt(kMaxCellsPerSegment * count));
  cell_ = std::max({length / count, side / cells_per_side, 1e-300});
  size_ = CellOf(bounds_.max()) + Eigen::Vector2i::Ones();

  const auto for_cells = [&](const SegmentRef& s, auto&& visit) {
    const Eigen::Vector2i low = CellOf(s.a.cwiseMin(s.b)), high = CellOf(s.a.cwiseMax(s.b));
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) visit(y * size_.x() + x);
    }
  };
  starts_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) + 1, 0);
  for (const SegmentRef& s : segments_) {
    for_cells(s, [&](int c) { ++starts_[static_cast<std::size_t>(c) + 1]; });
  }
  for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
  items_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    for_cells(segments_[i],
              [&](int c) { items_[next[static_cast<std::size_t>(c)]++] = static_cast<int>(i); });
  }
}

Eigen::Vector2i SegmentGrid::CellOf(const Eigen::Vector2d& p) const {
  return ((p - bounds_.min()) / cell_).array().floor().cast<int>();
}

std::vector<int> SegmentGrid::Candidates(const Eigen::AlignedBox2d& box) const {
  std::vector<int> found;
  const Eigen::AlignedBox2d inside = box.intersection(bounds_);
  if (segments_.empty() || inside.isEmpty()) return found;
  const Eigen::Vector2i low = CellOf(inside.min()), high = CellOf(inside.max());
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const auto c = static_cast<std::size_t>(y * size_.x() + x);
      found.insert(found.end(), items_.begin() + starts_[c], items_.begin() + starts_[c + 1]);
    }
  }
  return Ascending(std::move(found), segments_.size());
}

}  // namespace lascaux

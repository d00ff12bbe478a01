#include "sketch/map/slit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// The points of a walk in square cells as wide as the slit: its two sides are in the same cell or
/// in neighbours.
class SlitGrid {
 public:
  SlitGrid(const OuterWalk& walk, const SlitSearch& search) : walk_(walk), search_(search) {
    const Vector2d origin = walk.points.front().position;
    points_.reserve(walk.points.size());
    for (std::size_t i = 0; i < walk.points.size(); ++i) {
      const Vector2d cell = ((walk.points[i].position - origin) / search.reach).array().floor();
      points_.push_back(
          {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()), i});
    }
    std::sort(points_.begin(), points_.end());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const bool is_new = cells_.empty() || points_[i].x != points_[cells_.back().first].x ||
                          points_[i].y != points_[cells_.back().first].y;
      if (is_new) cells_.push_back({i, i, kInfinity, -kInfinity, 0});
      Extend(cells_.back(), i);
    }
  }

  std::optional<Slit> Narrowest() {
    // Each pair of neighbours once: a cell with itself, the one above, and three to the right.
    constexpr std::array<std::array<std::int64_t, 2>, 5> kSteps{
        {{0, 0}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};
    for (const auto& step : kSteps) {
      std::size_t other = 0;  // both walk through the cells in the same order
      for (const Cell& cell : cells_) {
        const GridPoint& at = points_[cell.first];
        const std::pair wanted(at.x + step[0], at.y + step[1]);
        const auto place = [&] {
          const GridPoint& there = points_[cells_[other].first];
          return std::pair(there.x, there.y);
        };
        while (other < cells_.size() && place() < wanted) ++other;
        if (other == cells_.size()) break;
        if (place() == wanted) Compare(cell, cells_[other]);
      }
    }
    return best_ ? std::optional(Bridge()) : std::nullopt;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  struct GridPoint {
    std::int64_t x, y;
    std::size_t index;  ///< in the walk
    auto operator<=>(const GridPoint&) const = default;
  };

  struct Cell {
    std::size_t first, last;  ///< its points
    double low, high;         ///< least and largest area swept until one of them
    double away;              ///< farthest of them from the walk's beginning
  };

  /// Two points of the walk, the earlier one first.
  struct Pair {
    double width;
    std::size_t i, j;
    auto operator<=>(const Pair&) const = default;
  };

  void Extend(Cell& cell, std::size_t i) {
    const WalkPoint& p = walk_.points[points_[i].index];
    cell.last = i + 1;
    cell.low = std::min(cell.low, p.double_area);
    cell.high = std::max(cell.high, p.double_area);
    cell.away = std::max(cell.away, (p.position - walk_.points.front().position).norm());
  }

  /// No bridge between two cells closes a larger face: what was swept on the way, and the triangle
  /// between the bridge and the walk's beginning.
  double MostArea(const Cell& a, const Cell& b) const {
    const double low = std::min(a.low, b.low), high = std::max(a.high, b.high);
    const double swept = high - low + search_.reach * std::min(a.away, b.away);
    return 0.5 * std::max(swept, walk_.double_area + swept) * (1 + 1e-9);
  }

  void Compare(const Cell& a, const Cell& b) {
    if (MostArea(a, b) < search_.least_area) return;
    for (std::size_t k = a.first; k < a.last; ++k) {
      for (std::size_t l = &a == &b ? k + 1 : b.first; l < b.last; ++l) {
        const auto [i, j] = std::minmax(points_[k].index, points_[l].index);
        const double width = (walk_.points[j].position - walk_.points[i].position).norm();
        if (width == 0 || width > search_.reach || (best_ && Pair{width, i, j} > *best_)) continue;
        if (walk_.Along(i, j) < search_.least_along || walk_.FaceArea(i, j) < search_.least_area)
          continue;
        best_ = Pair{width, i, j};
      }
    }
  }

  Slit Bridge() const {
    const Vector2d& p = walk_.points[best_->i].position;
    const Vector2d& q = walk_.points[best_->j].position;
    return p.x() <= q.x() ? Slit{p, q, best_->width} : Slit{q, p, best_->width};
  }

  const OuterWalk& walk_;
  const SlitSearch& search_;
  std::vector<GridPoint> points_;  ///< by cell
  std::vector<Cell> cells_;
  std::optional<Pair> best_;
};

}  // namespace

std::optional<Slit> NarrowestSlit(const OuterWalk& walk, const SlitSearch& search) {
  return SlitGrid(walk, search).Narrowest();
}

}  // namespace lascaux

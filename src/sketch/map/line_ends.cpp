#include "sketch/map/line_ends.h"

#include <utility>

namespace lascaux {

using Eigen::Vector2d;

namespace {

/// How many times as far as an end looks its own line has to run before it is another line to it.
constexpr double kOwnStretch = 3;

}  // namespace

std::vector<LineEnd> EndsOf(const std::vector<ArrangementLine>& lines) {
  std::vector<LineEnd> ends;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].closed) continue;
    ends.push_back({static_cast<int>(i), false, lines[i].points.front()});
    ends.push_back({static_cast<int>(i), true, lines[i].points.back()});
  }
  return ends;
}

SegmentGrid GridOf(const std::vector<ArrangementLine>& lines) {
  std::vector<SegmentRef> segments;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k + 1 < lines[i].points.size(); ++k) {
      segments.push_back(
          {static_cast<int>(i), static_cast<int>(k), lines[i].points[k], lines[i].points[k + 1]});
    }
  }
  return SegmentGrid(std::move(segments));
}

Eigen::AlignedBox2d BoxAround(const Vector2d& place, double radius) {
  const Vector2d r = Vector2d::Constant(radius);
  return {Vector2d(place - r), Vector2d(place + r)};
}

OwnStretch::OwnStretch(const ArrangementLine& line, const LineEnd& end, double reach)
    : line_(end.line), at_back_(end.at_back) {
  const Polyline& points = line.points;
  const int n = static_cast<int>(points.size());
  double along = 0;
  for (int k = 1; k < n; ++k) {
    const int i = at_back_ ? n - 1 - k : k, before = at_back_ ? i + 1 : i - 1;
    along +=
        (points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(before)]).norm();
    reach_ = i;
    if (along >= kOwnStretch * reach) return;
  }
}

std::optional<Overshoot> FindOvershoot(const ArrangementLine& line, const LineEnd& end,
                                       const SegmentGrid& grid) {
  const int n = static_cast<int>(line.points.size());
  const OwnStretch own(line, end, line.snap);
  const auto from_end = [&](int k) -> const Vector2d& {
    return line.points[static_cast<std::size_t>(end.at_back ? n - 1 - k : k)];
  };
  std::optional<Overshoot> first;
  double along = 0;
  for (int k = 0; k + 1 < n && along < line.snap; ++k) {
    const Vector2d &a = from_end(k), &b = from_end(k + 1);
    Eigen::AlignedBox2d box(a);
    box.extend(b);
    grid.ForEachIn(box, [&](int s) {
      const SegmentRef& other = grid.segments()[static_cast<std::size_t>(s)];
      if (own.Holds(other)) return;
      const auto hit = Intersection(a, b, other.a, other.b);
      if (!hit) return;
      const Vector2d at = a + hit->first * (b - a);
      const double rest = along + (at - a).norm();
      if ((at - end.position).norm() > line.snap || (first && rest <= first->rest)) return;
      first = {at, rest};
    });
    along += (b - a).norm();
  }
  return first;
}

}  // namespace lascaux

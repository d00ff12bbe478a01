#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "base/union_find.h"
#include "sketch/map/arrangement.h"
#include "sketch/map/segment_grid.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// An end that is no farther than this share of the diagonal from another line may be meant to meet
/// it; most others are a suggestive curve's.
constexpr double kOpen = 0.03;
/// Ends that have to be that near before anything is said of the hand that drew them; with more
/// ends than the other number lines are everywhere.
constexpr std::size_t kFewestEnds = 8, kMostEnds = 1000;
/// Of ends that a hand lets miss by a median distance nearly all miss by less than so many times
/// it.
constexpr double kMedians = 3.5;

/// One end of an open line.
struct LineEnd {
  int line = 0;
  bool at_back = false;
  Vector2d position;
};

/// The point of a line that an end goes onto.
struct SnapTarget {
  Vector2d point;
  double distance = 0;
};

std::vector<LineEnd> EndsOf(const std::vector<ArrangementLine>& lines) {
  std::vector<LineEnd> ends;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].closed) continue;
    ends.push_back({static_cast<int>(i), false, lines[i].points.front()});
    ends.push_back({static_cast<int>(i), true, lines[i].points.back()});
  }
  return ends;
}

Eigen::AlignedBox2d BoxAround(const Vector2d& p, double radius) {
  const Vector2d r = Vector2d::Constant(radius);
  return {Vector2d(p - r), Vector2d(p + r)};
}

/// Index of the first point beyond arc length `reach` from the end; the segments before it are the
/// end's own neighbourhood.
int ReachFromEnd(const Polyline& points, const LineEnd& end, double reach) {
  const int n = static_cast<int>(points.size());
  double s = 0;
  for (int k = 1; k < n; ++k) {
    const int i = end.at_back ? n - 1 - k : k, before = end.at_back ? i + 1 : i - 1;
    s += (points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(before)]).norm();
    if (s >= reach) return i;
  }
  return end.at_back ? 0 : n - 1;
}

bool IsNearOwnEnd(const SegmentRef& segment, const LineEnd& end, int reach) {
  if (segment.line != end.line) return false;
  return end.at_back ? segment.index + 1 > reach : segment.index < reach;
}

/// True when the last `radius` of the line before its end crosses another line: the rest is an
/// overshoot.
bool Overshoots(const Polyline& points, const LineEnd& end, double radius,
                const SegmentGrid& grid) {
  const int reach = ReachFromEnd(points, end, radius), own = ReachFromEnd(points, end, 3 * radius);
  const int n = static_cast<int>(points.size());
  const int from = end.at_back ? reach : 0, to = end.at_back ? n - 1 : reach;
  bool crosses = false;
  for (int i = from; i < to && !crosses; ++i) {
    const Vector2d &a = points[static_cast<std::size_t>(i)],
                   &b = points[static_cast<std::size_t>(i + 1)];
    Eigen::AlignedBox2d box(a);
    box.extend(b);
    grid.ForEachIn(box, [&](int s) {
      const SegmentRef& other = grid.segments()[static_cast<std::size_t>(s)];
      if (other.line == end.line && IsNearOwnEnd(other, end, own)) return;
      const auto hit = Intersection(a, b, other.a, other.b);
      if (!hit) return;
      const Vector2d at = a + hit->first * (b - a);
      crosses = crosses || (at - end.position).norm() <= radius;
    });
  }
  return crosses;
}

/// The nearest place of a line within `radius`, without segments that are skipped.
template <typename Skip>
std::optional<SnapTarget> NearestLine(const Vector2d& place, double radius, const SegmentGrid& grid,
                                      Skip&& skip) {
  std::optional<SnapTarget> best;
  grid.ForEachIn(BoxAround(place, radius), [&](int s) {
    const SegmentRef& other = grid.segments()[static_cast<std::size_t>(s)];
    if (skip(other)) return;
    const Vector2d point =
        other.a + NearestParameter(other.a, other.b, place) * (other.b - other.a);
    const double distance = (point - place).norm();
    if (distance <= radius && (!best || distance < best->distance)) best = {point, distance};
  });
  return best;
}

/// The nearest other line, or far part of the same line.
std::optional<SnapTarget> NearestOther(const Polyline& points, const LineEnd& end, double radius,
                                       const SegmentGrid& grid) {
  const int own = ReachFromEnd(points, end, 3 * radius);
  return NearestLine(end.position, radius, grid,
                     [&](const SegmentRef& s) { return IsNearOwnEnd(s, end, own); });
}

/// Ends in the order of x, so that those near another are found in a narrow window.
class EndIndex {
 public:
  explicit EndIndex(const std::vector<LineEnd>& ends) : ends_(ends), order_(ends.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return X(a) < X(b); });
  }

  /// Calls visit(other, distance) for all other ends within `radius`.
  template <typename Visit>
  void ForEachWithin(int self, double radius, Visit&& visit) const {
    const Vector2d& at = ends_[static_cast<std::size_t>(self)].position;
    auto i = std::lower_bound(order_.begin(), order_.end(), at.x() - radius,
                              [&](int e, double x) { return X(e) < x; });
    for (; i != order_.end() && X(*i) <= at.x() + radius; ++i) {
      const double distance = (ends_[static_cast<std::size_t>(*i)].position - at).norm();
      if (*i != self && distance <= radius) visit(*i, distance);
    }
  }

 private:
  double X(int end) const { return ends_[static_cast<std::size_t>(end)].position.x(); }

  const std::vector<LineEnd>& ends_;
  std::vector<int> order_;
};

/// How far ends that are meant to meet a line miss it: the median; 0 where few are near any. Lines
/// that were made by a program meet exactly, so nearly half of them may end near others on purpose.
double MedianMiss(const std::vector<ArrangementLine>& lines, const std::vector<LineEnd>& ends,
                  const SegmentGrid& grid, double diagonal) {
  std::vector<double> misses;
  if (ends.size() > kMostEnds) return 0;
  for (const LineEnd& end : ends) {
    const ArrangementLine& line = lines[static_cast<std::size_t>(end.line)];
    for (const double radius : {1e-4 * diagonal, kOpen * diagonal}) {
      const auto nearest = NearestOther(line.points, end, radius, grid);
      if (nearest) misses.push_back(nearest->distance);
      if (nearest) break;
    }
  }
  if (misses.size() < kFewestEnds) return 0;
  const auto middle = misses.begin() + static_cast<std::ptrdiff_t>((misses.size() - 1) / 2);
  std::nth_element(misses.begin(), middle, misses.end());
  return *middle;
}

/// Which ends meet: those near each other, together in a place no wider than they look far. Of many
/// ends in a row not all are drawn into one.
class Corners {
 public:
  Corners(const std::vector<ArrangementLine>& lines, const std::vector<LineEnd>& ends,
          const EndIndex& index)
      : lines_(lines), ends_(ends), sets_(ends.size()), count_(ends.size(), 1), box_(ends.size()) {
    for (std::size_t e = 0; e < ends.size(); ++e) box_[e].extend(ends[e].position);
    std::vector<std::optional<std::pair<double, int>>> nearest(ends.size());
    for (int e = 0; e < static_cast<int>(ends.size()); ++e) {
      auto& best = nearest[static_cast<std::size_t>(e)];
      index.ForEachWithin(e, Snap(e), [&](int other, double distance) {
        const std::pair candidate(distance, other);
        if (MayMeet(e, other) && (!best || candidate < *best)) best = candidate;
      });
    }
    for (int e = 0; e < static_cast<int>(ends.size()); ++e) {
      if (const auto& best = nearest[static_cast<std::size_t>(e)]) Join(e, best->second);
    }
    for (int e = 0; e < static_cast<int>(ends.size()); ++e) {
      index.ForEachWithin(e, Snap(e), [&](int other, double) {
        if (MayMeet(e, other)) Join(e, other);
      });
    }
  }

  /// The number of the corner that an end is at.
  std::uint32_t Of(int end) { return sets_.Root(static_cast<std::uint32_t>(end)); }

  bool IsShared(int end) { return count_[Of(end)] > 1; }

 private:
  double Snap(int end) const { return LineOf(end).snap; }

  const ArrangementLine& LineOf(int end) const {
    return lines_[static_cast<std::size_t>(ends_[static_cast<std::size_t>(end)].line)];
  }

  /// Ties of one line with itself need a real loop.
  bool MayMeet(int end, int other) const {
    return ends_[static_cast<std::size_t>(end)].line !=
               ends_[static_cast<std::size_t>(other)].line ||
           Length(LineOf(end).points) > 6 * Snap(end);
  }

  void Join(int end, int other) {
    const std::uint32_t a = Of(end), b = Of(other);
    if (a == b) return;
    const Eigen::AlignedBox2d both = box_[a].merged(box_[b]);
    if (both.diagonal().norm() > Snap(end)) return;
    const int count = count_[a] + count_[b];
    sets_.Join(a, b);
    box_[Of(end)] = both;
    count_[Of(end)] = count;
  }

  const std::vector<ArrangementLine>& lines_;
  const std::vector<LineEnd>& ends_;
  UnionFind sets_;
  std::vector<int> count_;                ///< of the ends of a corner, by its number
  std::vector<Eigen::AlignedBox2d> box_;  ///< around the ends of a corner, by its number
};

void MoveEnd(Polyline& points, const LineEnd& end, const Vector2d& target, double tiny) {
  if (end.at_back) std::reverse(points.begin(), points.end());
  const double distance = (points.front() - target).norm();
  if (distance > tiny) {
    // Bend the last stretch over instead of adding a hook: tangents are taken there.
    const double length = Length(points), cut = std::min(distance, 0.3 * length);
    points = Section(points, cut, length);
    points.insert(points.begin(), target);
  } else {
    points.front() = target;
  }
  if (end.at_back) std::reverse(points.begin(), points.end());
}

}  // namespace

std::vector<ArrangementLine> SnapEnds(std::vector<ArrangementLine> lines, double diagonal,
                                      double most) {
  std::vector<SegmentRef> segments;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k + 1 < lines[i].points.size(); ++k) {
      segments.push_back(
          {static_cast<int>(i), static_cast<int>(k), lines[i].points[k], lines[i].points[k + 1]});
    }
  }
  const SegmentGrid grid(std::move(segments));
  const std::vector<LineEnd> ends = EndsOf(lines);
  const EndIndex index(ends);
  const double hand = std::min(most, kMedians * MedianMiss(lines, ends, grid, diagonal));
  for (ArrangementLine& line : lines) line.snap = std::max(line.snap, hand);
  Corners corners(lines, ends, index);
  std::vector<std::pair<std::uint32_t, int>> lines_of;  // of each corner, all that end there
  for (std::size_t e = 0; e < ends.size(); ++e)
    lines_of.emplace_back(corners.Of(static_cast<int>(e)), ends[e].line);
  std::sort(lines_of.begin(), lines_of.end());
  std::vector<std::optional<Vector2d>> onto(ends.size());
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const ArrangementLine& line = lines[static_cast<std::size_t>(ends[e].line)];
    if (Overshoots(line.points, ends[e], line.snap, grid)) continue;
    // Where ends meet is a corner; all of it lies on another line if one is near.
    const std::uint32_t corner = corners.Of(static_cast<int>(e));
    const auto target =
        !corners.IsShared(static_cast<int>(e))
            ? NearestOther(line.points, ends[e], line.snap, grid)
            : NearestLine(ends[e].position, line.snap, grid, [&](const SegmentRef& s) {
                return std::binary_search(lines_of.begin(), lines_of.end(),
                                          std::pair(corner, s.line));
              });
    if (target) onto[e] = target->point;
  }
  // The ends of a corner meet at the first of them that has a line to lie on, else at the first.
  std::vector<std::optional<Vector2d>> meeting(ends.size());
  for (std::size_t e = 0; e < ends.size(); ++e) {
    auto& at = meeting[corners.Of(static_cast<int>(e))];
    if (!at) at = onto[e] ? *onto[e] : ends[e].position;
  }
  const double tiny = 1e-5 * diagonal;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    MoveEnd(lines[static_cast<std::size_t>(ends[e].line)].points, ends[e],
            *meeting[corners.Of(static_cast<int>(e))], tiny);
  }
  return lines;
}

}  // namespace lascaux

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "sketch/map/arrangement.h"
#include "sketch/map/line_ends.h"
#include "sketch/map/meetings.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// An end that is no farther than this share of the diagonal from another line may be meant to meet
/// it; most others are a suggestive curve's.
constexpr double kOpen = 0.03;
/// Ends that have to be that near before anything is said of the hand that drew them; with more
/// ends than the other number lines are everywhere.
constexpr std::size_t kFewestEnds = 8, kMostEnds = 1000;
/// Two ends of a hand that lets ends miss their line by a median distance are nearly always less
/// than so many times that apart: both miss, and the nearest line is not the one that is meant.
constexpr double kMedians = 5;
/// More than this share of the diagonal is no miss: legs and ears are as wide.
constexpr double kMostMiss = 0.02;
/// Nor is what is more than this share of the line itself: toes are not swallowed.
constexpr double kShare = 0.25;
/// A line that ends in the wrong place has run there from farther off: so many times as far as an
/// unsteady hand misses.
constexpr double kAstray = 5;
/// Pieces of that stretch: enough for a smooth bend.
constexpr double kPieces = 8;
/// Where an end goes, instead of how much of its line.
struct Move {
  Vector2d target;
  double stretch = 0;
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
      const OwnStretch own(line, end, radius);
      const auto nearest = NearestLine(end.position, radius, grid,
                                       [&](const SegmentRef& s) { return own.Holds(s); });
      if (nearest) misses.push_back(nearest->distance);
      if (nearest) break;
    }
  }
  if (misses.size() < kFewestEnds) return 0;
  const auto middle = misses.begin() + static_cast<std::ptrdiff_t>((misses.size() - 1) / 2);
  std::nth_element(misses.begin(), middle, misses.end());
  return *middle;
}

/// The same line with more points where they are far apart.
Polyline Densified(const Polyline& points, double step) {
  Polyline dense{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector2d &a = points[i - 1], &b = points[i];
    const int pieces = static_cast<int>(std::ceil((b - a).norm() / step));
    for (int k = 1; k < pieces; ++k) dense.push_back(a + (b - a) * k / pieces);
    dense.push_back(b);
  }
  return dense;
}

/// Moves an end, and the stretch before it along, less and less, so that the line's direction
/// stays. As much as the end is moved goes straight to it, instead of a hook; where that is the
/// whole stretch, all of it.
void MoveEnd(Polyline& points, const LineEnd& end, const Move& move) {
  if (end.at_back) std::reverse(points.begin(), points.end());
  const double length = Length(points), reach = std::min(move.stretch, 0.5 * length);
  if (reach > 0) {
    const Vector2d by = move.target - points.front();
    const double hook = reach > by.norm() ? std::min(by.norm(), 0.5 * reach) : reach;
    Polyline moved{move.target};
    double along = hook;
    Vector2d before = PointAtLength(points, hook);
    for (const Vector2d& p : Densified(Section(points, hook, reach), reach / kPieces)) {
      along += (p - before).norm();
      before = p;
      const double u = std::min(1.0, along / reach);
      moved.push_back(p + (1 - u) * (1 - u) * (1 + 2 * u) * by);
    }
    Append(moved, Section(points, reach, length));
    points = std::move(moved);
  }
  points.front() = move.target;
  if (end.at_back) std::reverse(points.begin(), points.end());
}

class Snapping {
 public:
  Snapping(std::vector<ArrangementLine> lines, double diagonal)
      : lines_(std::move(lines)), ends_(EndsOf(lines_)), grid_(GridOf(lines_)), size_(diagonal) {
    const double hand =
        std::min(kMostMiss * diagonal, kMedians * MedianMiss(lines_, ends_, grid_, diagonal));
    for (ArrangementLine& line : lines_) {
      is_unsteady_ = is_unsteady_ || hand > line.snap;
      line.snap = std::max(line.snap, std::min(hand, kShare * Length(line.points)));
    }
  }

  std::vector<ArrangementLine> Run() {
    const std::vector<Meeting> meetings = FindMeetings(lines_, ends_, grid_);
    bool moved = false;
    for (const Meeting& meeting : meetings) {
      if (meeting.ends.size() < 2) continue;
      const Vector2d target = PlaceOf(meeting);
      for (const int e : meeting.ends) moved = Apply(e, {target, 0}) || moved;
    }
    if (moved) grid_ = GridOf(lines_);
    // All places first: lines that have moved no longer are those of the grid.
    std::vector<std::pair<int, Move>> singles;
    for (const Meeting& meeting : meetings) {
      if (meeting.ends.size() > 1 || !meeting.line) continue;
      if (const auto move = OntoLine(meeting)) singles.emplace_back(meeting.ends.front(), *move);
    }
    for (const auto& [end, move] : singles) Apply(end, move);
    return std::move(lines_);
  }

 private:
  const LineEnd& End(int end) const { return ends_[static_cast<std::size_t>(end)]; }
  ArrangementLine& LineOf(int end) { return lines_[static_cast<std::size_t>(End(end).line)]; }

  /// Where ends meet: where the first was drawn that has not crossed their line, or in their middle
  /// if a hand misses anyway; on that line.
  Vector2d PlaceOf(const Meeting& meeting) {
    const std::vector<int>& ends = meeting.ends;
    Vector2d at = End(ends.front()).position;
    if (is_unsteady_) {
      at.setZero();
      for (const int e : ends) at += End(e).position / static_cast<double>(ends.size());
    } else if (meeting.line) {
      const auto falls_short = std::find_if(ends.begin(), ends.end(), [&](int e) {
        return !FindOvershoot(LineOf(e), End(e), grid_);
      });
      if (falls_short == ends.end()) return at;
      at = End(*falls_short).position;
    }
    if (!meeting.line) return at;
    const auto near = NearestLine(at, 2 * LineOf(ends.front()).snap, grid_,
                                  [&](const SegmentRef& s) { return s.line != *meeting.line; });
    return near ? near->point : at;
  }

  /// Where an end meets its line; none where it has crossed one and a steady hand leaves a spur.
  std::optional<Move> OntoLine(const Meeting& meeting) {
    const int end = meeting.ends.front();
    const ArrangementLine& line = LineOf(end);
    if (const auto crossed = FindOvershoot(line, End(end), grid_))
      return is_unsteady_ ? std::optional<Move>({crossed->point, crossed->rest}) : std::nullopt;
    const OwnStretch own(line, End(end), line.snap);
    const auto near =
        NearestLine(End(end).position, 2 * line.snap, grid_,
                    [&](const SegmentRef& s) { return s.line != *meeting.line || own.Holds(s); });
    if (!near) return std::nullopt;
    return Move{near->point, 0};
  }

  /// True when that changed the line.
  bool Apply(int end, Move move) {
    const double distance = (End(end).position - move.target).norm();
    const bool moves = distance > 1e-5 * size_;
    const double least = (is_unsteady_ ? kAstray : 1) * distance;
    move.stretch = moves ? std::max(move.stretch, least) : 0;
    MoveEnd(LineOf(end).points, End(end), move);
    return moves;
  }

  std::vector<ArrangementLine> lines_;
  std::vector<LineEnd> ends_;
  SegmentGrid grid_;
  double size_;
  bool is_unsteady_ = false;  ///< ends look farther than they do anyway
};

}  // namespace

std::vector<ArrangementLine> SnapEnds(std::vector<ArrangementLine> lines, double diagonal) {
  return Snapping(std::move(lines), diagonal).Run();
}

}  // namespace lascaux

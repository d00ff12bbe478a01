#include "sketch/map/meetings.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/union_find.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// How far ends that meet are from their middle, as a share of how far they look for each other:
/// three that miss their place by half of that, in any direction, are up to 0.67 from it, and what
/// is between them and another corner is seldom less.
constexpr double kSpread = 0.8;
/// Ends of one line meet only if that makes a real loop, so many times as long as they look far:
/// the tips of an ear that is one line stay apart.
constexpr double kLoop = 10;
/// Nearer others of one end than this are fur.
constexpr std::size_t kMostOthers = 8;

/// An end and what it may meet.
struct Candidate {
  double cost = 0;  ///< distance as a share of how far the end looks
  int end = 0;
  bool is_line = false;
  int other = 0;  ///< an end, or a line
  auto operator<=>(const Candidate&) const = default;
};

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

void KeepNearest(std::vector<Candidate>& candidates) {
  std::sort(candidates.begin(), candidates.end());
  if (candidates.size() > kMostOthers) candidates.resize(kMostOthers);
}

class Search {
 public:
  Search(const std::vector<ArrangementLine>& lines, const std::vector<LineEnd>& ends,
         const SegmentGrid& grid)
      : lines_(lines), ends_(ends), grid_(grid), sets_(ends.size()) {
    for (int e = 0; e < static_cast<int>(ends.size()); ++e) meetings_.push_back({{e}, {}});
  }

  std::vector<Meeting> Run() {
    const EndIndex index(ends_);
    std::vector<Candidate> candidates;
    for (int e = 0; e < static_cast<int>(ends_.size()); ++e) {
      for (const Candidate& c : Others(index, e)) candidates.push_back(c);
      for (const Candidate& c : Lines(e)) candidates.push_back(c);
    }
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& c : candidates) c.is_line ? Attach(c) : Join(c);
    std::vector<Meeting> found;
    for (std::uint32_t e = 0; e < ends_.size(); ++e) {
      if (!sets_.IsRoot(e)) continue;
      std::sort(meetings_[e].ends.begin(), meetings_[e].ends.end());
      found.push_back(std::move(meetings_[e]));
    }
    return found;
  }

 private:
  const LineEnd& End(int end) const { return ends_[static_cast<std::size_t>(end)]; }
  const ArrangementLine& Line(int line) const { return lines_[static_cast<std::size_t>(line)]; }
  double Reach(int end) const { return Line(End(end).line).snap; }

  std::uint32_t RootOf(int end) { return sets_.Root(static_cast<std::uint32_t>(end)); }

  bool MayMeet(int end, int other) const {
    const int line = End(end).line;
    return line != End(other).line || Length(Line(line).points) > kLoop * Reach(end);
  }

  std::vector<Candidate> Others(const EndIndex& index, int end) const {
    std::vector<Candidate> found;
    index.ForEachWithin(end, Reach(end), [&](int other, double distance) {
      if (MayMeet(end, other)) found.push_back({distance / Reach(end), end, false, other});
    });
    KeepNearest(found);
    return found;
  }

  /// Near a line's own end that end comes first.
  std::vector<Candidate> Lines(int end) const {
    const double reach = Reach(end);
    const Vector2d& at = End(end).position;
    const OwnStretch own(Line(End(end).line), End(end), reach);
    std::vector<Candidate> found;
    for (const NearPlace& near :
         NearLines(at, reach, grid_, [&](const SegmentRef& s) { return own.Holds(s); })) {
      const ArrangementLine& line = Line(near.line);
      double distance = near.distance;
      for (const Vector2d& tip : {line.points.front(), line.points.back()}) {
        if (!line.closed && (near.point - tip).norm() < reach)
          distance = std::max(distance, (at - tip).norm());
      }
      found.push_back({distance / reach, end, true, near.line});
    }
    KeepNearest(found);
    return found;
  }

  bool IsNear(int end, int line) const {
    return NearestLine(End(end).position, Reach(end), grid_,
                       [&](const SegmentRef& s) { return s.line != line; })
        .has_value();
  }

  /// True when a middle is near enough to all of the ends.
  bool AreClose(const std::vector<int>& ends, double reach) const {
    Vector2d middle = Vector2d::Zero();
    for (const int e : ends) middle += End(e).position / static_cast<double>(ends.size());
    return std::all_of(ends.begin(), ends.end(),
                       [&](int e) { return (End(e).position - middle).norm() <= kSpread * reach; });
  }

  void Join(const Candidate& c) {
    const std::uint32_t a = RootOf(c.end), b = RootOf(c.other);
    if (a == b) return;
    const Meeting &first = meetings_[a], &second = meetings_[b];
    if (first.line && second.line && first.line != second.line) return;
    for (const int e : first.ends) {
      for (const int f : second.ends) {
        if (!MayMeet(e, f)) return;
      }
    }
    Meeting both = first;
    both.ends.insert(both.ends.end(), second.ends.begin(), second.ends.end());
    if (!both.line) both.line = second.line;
    if (!AreClose(both.ends, Reach(c.end))) return;
    // Where one of them is the line's own end, that is the place.
    const auto is_own = [&](int e) { return End(e).line == both.line; };
    if (std::any_of(both.ends.begin(), both.ends.end(), is_own)) both.line.reset();
    const auto is_near = [&](int e) { return !both.line || IsNear(e, *both.line); };
    if (!std::all_of(both.ends.begin(), both.ends.end(), is_near)) return;
    sets_.Join(a, b);
    meetings_[RootOf(c.end)] = std::move(both);
  }

  void Attach(const Candidate& c) {
    Meeting& meeting = meetings_[RootOf(c.end)];
    if (meeting.line) return;
    const auto fits = [&](int e) {
      return e == c.end || (End(e).line != c.other && IsNear(e, c.other));
    };
    const bool is_own = meeting.ends.size() > 1 && End(c.end).line == c.other;
    if (!is_own && std::all_of(meeting.ends.begin(), meeting.ends.end(), fits))
      meeting.line = c.other;
  }

  const std::vector<ArrangementLine>& lines_;
  const std::vector<LineEnd>& ends_;
  const SegmentGrid& grid_;
  UnionFind sets_;
  std::vector<Meeting> meetings_;  ///< by the root of their ends
};

}  // namespace

std::vector<Meeting> FindMeetings(const std::vector<ArrangementLine>& lines,
                                  const std::vector<LineEnd>& ends, const SegmentGrid& grid) {
  return Search(lines, ends, grid).Run();
}

}  // namespace lascaux

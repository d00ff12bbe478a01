#include "sketch/map/closures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "sketch/map/polyline.h"
#include "sketch/map/segment_grid.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// What a straight closure has to enclose, in squares of its length: whiskers and curls don't.
constexpr double kSquares = 4;
/// A turn of this much doubles the price.
constexpr double kDoublingTurn = std::numbers::pi / 3;
/// Ends are meant to meet ends: a closure to a line's middle costs more.
constexpr double kMiddle = 1.5;
/// A gap below this share of the diagonal is a slip of the pen, whichever way its lines point.
constexpr double kSlip = 0.01;
/// An end's own line is no target before it has run so many times the closure's length.
constexpr double kOwnLine = 3;
/// Closures kept for each end.
constexpr std::size_t kKept = 6;

struct Tip {
  Vector2d position, outward;
  int half_edge = 0;  ///< the one that begins here
};

/// The lines on one side of the outline: what closures may run to and must not cross.
class Lines {
 public:
  Lines(const PlanarMap& map, ClosureSide side) : map_(map), side_(side), grid_(SegmentsOf(map)) {
    for (const MapNode& node : map.nodes) {
      if (node.outgoing.size() != 1) continue;
      const int h = node.outgoing.front();
      if (IsOnSide(h)) tips_.push_back({node.position, -map.Departure(h), h});
    }
    std::stable_sort(tips_.begin(), tips_.end(),
                     [](const Tip& a, const Tip& b) { return a.position.x() < b.position.x(); });
  }

  const std::vector<Tip>& tips() const { return tips_; }
  const SegmentGrid& grid() const { return grid_; }
  const PlanarMap& map() const { return map_; }

  bool MayMeet(int edge) const { return IsOnSide(2 * edge) || IsOnSide(2 * edge + 1); }

  /// True when a line runs through between the two places.
  bool Blocked(const Vector2d& from, const Vector2d& to) const {
    constexpr double kEnds = 1e-6;
    Eigen::AlignedBox2d box(from);
    box.extend(to);
    bool blocked = false;
    grid_.ForEachIn(box, [&](int s) {
      const SegmentRef& line = grid_.segments()[static_cast<std::size_t>(s)];
      const auto hit = Intersection(from, to, line.a, line.b);
      blocked = blocked || (hit && hit->first > kEnds && hit->first < 1 - kEnds);
    });
    return blocked;
  }

  /// Length of the tip's own edge from the tip to a place on its segment.
  double AlongOwn(const Tip& tip, int index, const Vector2d& place) const {
    const Polyline points = map_.Points(tip.half_edge);
    const int n = static_cast<int>(points.size());
    const int last = tip.half_edge % 2 == 0 ? index : n - 2 - index;
    double along = (points[static_cast<std::size_t>(last)] - place).norm();
    for (int i = 0; i < last; ++i) {
      along +=
          (points[static_cast<std::size_t>(i) + 1] - points[static_cast<std::size_t>(i)]).norm();
    }
    return along;
  }

 private:
  bool IsOnSide(int h) const {
    const int cycle = map_.cycle[static_cast<std::size_t>(h)];
    const bool outer = map_.cycles[static_cast<std::size_t>(cycle)].kind == CycleKind::kOuter;
    return outer == (side_ == ClosureSide::kOutside);
  }

  static std::vector<SegmentRef> SegmentsOf(const PlanarMap& map) {
    std::vector<SegmentRef> segments;
    for (std::size_t e = 0; e < map.edges.size(); ++e) {
      const Polyline& points = map.edges[e].points;
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        segments.push_back({static_cast<int>(e), static_cast<int>(k), points[k], points[k + 1]});
      }
    }
    return segments;
  }

  const PlanarMap& map_;
  ClosureSide side_;
  SegmentGrid grid_;
  std::vector<Tip> tips_;
};

/// Closures from one tip.
class TipSearch {
 public:
  TipSearch(const Lines& lines, const ClosureSearch& search, std::size_t tip)
      : lines_(lines), search_(search), self_(tip), tip_(lines.tips()[tip]) {}

  std::vector<Closure> Run() {
    ToTips();
    ToNearest();
    Ahead();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Closure& a, const Closure& b) { return a.price < b.price; });
    std::vector<Closure> kept;
    for (const Closure& c : found_) {
      if (kept.size() == kKept) break;
      if (!lines_.Blocked(c.from, c.to)) kept.push_back(c);
    }
    return kept;
  }

 private:
  void ToTips() {
    const std::vector<Tip>& tips = lines_.tips();
    // On the outside each pair once, from the tip farther to the left; inside each tip is one to
    // choose for by itself.
    std::size_t k = self_ + 1;
    if (search_.side == ClosureSide::kInside) {
      while (k > 0 && tip_.position.x() - tips[k - 1].position.x() <= search_.reach) --k;
    }
    for (; k < tips.size(); ++k) {
      if (tips[k].position.x() - tip_.position.x() > search_.reach) break;
      if (k == self_) continue;
      const bool same = tips[k].half_edge / 2 == tip_.half_edge / 2;
      const double distance = (tips[k].position - tip_.position).norm();
      if (same && EdgeLength(tip_.half_edge / 2) < kOwnLine * distance) continue;
      Add(tips[k].position, tips[k].outward);
    }
  }

  void ToNearest() {
    std::map<int, std::pair<double, Vector2d>> nearest;  // by edge
    const Vector2d r = Vector2d::Constant(search_.reach);
    lines_.grid().ForEachIn({Vector2d(tip_.position - r), Vector2d(tip_.position + r)}, [&](int s) {
      const SegmentRef& line = lines_.grid().segments()[static_cast<std::size_t>(s)];
      const Vector2d place =
          line.a + NearestParameter(line.a, line.b, tip_.position) * (line.b - line.a);
      const double distance = (place - tip_.position).norm();
      if (distance > search_.reach || !MayMeet(line, place, distance)) return;
      const auto [entry, is_new] = nearest.try_emplace(line.line, distance, place);
      if (!is_new && distance < entry->second.first) entry->second = {distance, place};
    });
    for (const auto& [edge, place] : nearest) Add(place.second, Vector2d::Zero());
  }

  /// The first line that the tip points at.
  void Ahead() {
    const Vector2d end = tip_.position + search_.reach * tip_.outward;
    Eigen::AlignedBox2d box(tip_.position);
    box.extend(end);
    std::optional<std::pair<double, Vector2d>> first;
    lines_.grid().ForEachIn(box, [&](int s) {
      const SegmentRef& line = lines_.grid().segments()[static_cast<std::size_t>(s)];
      const auto hit = Intersection(tip_.position, end, line.a, line.b);
      if (!hit || (first && hit->first >= first->first)) return;
      const Vector2d place = tip_.position + hit->first * (end - tip_.position);
      if (MayMeet(line, place, hit->first * search_.reach)) first = {hit->first, place};
    });
    if (first) Add(first->second, Vector2d::Zero());
  }

  bool MayMeet(const SegmentRef& line, const Vector2d& place, double distance) const {
    if (!(distance > 0) || !lines_.MayMeet(line.line)) return false;
    return line.line != tip_.half_edge / 2 ||
           lines_.AlongOwn(tip_, line.index, place) >= kOwnLine * distance;
  }

  double EdgeLength(int edge) const {
    return Length(lines_.map().edges[static_cast<std::size_t>(edge)].points);
  }

  void Add(const Vector2d& to, const Vector2d& to_direction) {
    const Vector2d way = to - tip_.position;
    const double distance = way.norm();
    if (!(distance > 0) || distance > search_.reach) return;
    const bool is_end = !to_direction.isZero(0);
    double turn = AngleBetween(tip_.outward, way);
    if (is_end) turn = std::max(turn, AngleBetween(to_direction, -way));
    if (turn > search_.max_turn && distance > kSlip * lines_.map().diagonal) return;
    const double bend = turn / kDoublingTurn;
    const double price =
        kSquares * (1 + bend * bend) * (is_end ? 1.0 : kMiddle) * distance * distance;
    found_.push_back({tip_.position, to, tip_.half_edge, tip_.outward, to_direction, price, turn});
  }

  const Lines& lines_;
  const ClosureSearch& search_;
  std::size_t self_;
  const Tip& tip_;
  std::vector<Closure> found_;
};

}  // namespace

std::vector<Closure> FindClosures(const PlanarMap& map, const ClosureSearch& search) {
  const Lines lines(map, search.side);
  std::vector<Closure> closures;
  for (std::size_t t = 0; t < lines.tips().size(); ++t) {
    for (Closure& c : TipSearch(lines, search, t).Run()) closures.push_back(std::move(c));
  }
  return closures;
}

}  // namespace lascaux

#include "sketch/depth/place_cells.h"

#include <algorithm>

#include "sketch/depth/side_cells.h"
#include "sketch/parts/evidence.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Index = std::size_t;

/// How much nearer a cell lies to the limb's tip, the point farthest from its top, than to its root
/// (Evidence): below 0 it is at the root.
double AtTip(const Part& limb, const Part& cell) {
  const LimbRoot& root = *limb.root;
  const Vector2d joint = 0.5 * (root.closed[0] + root.closed[1]);
  const Vector2d top = 0.5 * (root.open[0] + root.open[1]), at = Centroid(cell.outline.points);
  const auto& points = limb.outline.points;
  const Vector2d tip =
      *std::max_element(points.begin(), points.end(), [&](const Vector2d& p, const Vector2d& q) {
        return (p - top).squaredNorm() < (q - top).squaredNorm();
      });
  return Evidence().AtMost((at - tip).norm(), (at - joint).norm()).Score();
}

class Placer {
 public:
  Placer(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency, DepthGraph& graph)
      : parts_(parts),
        adjacency_(adjacency),
        graph_(graph),
        side_cells_(map, parts, adjacency, graph),
        placed_(parts.parts.size()) {}

  void Run() {
    placed_[static_cast<Index>(graph_.body)] = true;
    PlaceLimbs();
    while (const auto next = LongestShared()) {
      Place(next->first, next->second);
      PlaceLimbs();
    }
    for (Index i = 0; i < placed_.size(); ++i) {
      const bool loose_limb = graph_.nodes[i].relation == Relation::kOver && !placed_[i];
      if (IsOpen(i) || loose_limb) graph_.nodes[i].role = PartRole::kIgnored;
    }
    PairSideCells();
  }

 private:
  /// True for a cell that waits for its place.
  bool IsOpen(Index i) const {
    return !placed_[i] && parts_.parts[i].kind == PartKind::kBorder &&
           graph_.nodes[i].relation != Relation::kUnder;
  }

  /// Limbs have their place with the part that they lie over, and not before it: else that part
  /// could be placed by what hangs on its own limb.
  void PlaceLimbs() {
    for (bool again = true; again;) {
      again = false;
      for (Index i = 0; i < placed_.size(); ++i) {
        const DepthNode& node = graph_.nodes[i];
        if (placed_[i] || node.relation != Relation::kOver) continue;
        if (node.parent && placed_[static_cast<Index>(*node.parent)]) placed_[i] = again = true;
      }
    }
  }

  /// The open cell that shares the longest line with a placed part, and that part.
  std::optional<std::pair<int, int>> LongestShared() const {
    double longest = 0;
    std::optional<std::pair<int, int>> next;
    for (Index i = 0; i < placed_.size(); ++i) {
      if (!IsOpen(i)) continue;
      for (const auto& [other, length] : adjacency_.shared[i]) {
        if (!placed_[static_cast<Index>(other)] || length <= longest) continue;
        longest = length;
        next = {static_cast<int>(i), other};
      }
    }
    return next;
  }

  void Place(int cell, int parent) {
    const Part& part = parts_.parts[static_cast<Index>(cell)];
    // Beside a limb's far end: more of the limb (a hoof). Beside its root: something in the plane
    // that the limb hides.
    double at_tip = 1;  // for more of something that is more of a limb
    for (const Part* limb = &parts_.parts[static_cast<Index>(parent)]; limb->root;
         limb = &parts_.parts[static_cast<Index>(parent)]) {
      at_tip = AtTip(*limb, part);
      if (at_tip >= 0) break;
      parent = *limb->over;
      at_tip = 1;
    }
    const PartRole parent_role = graph_.nodes[static_cast<Index>(parent)].role;
    DepthNode& node = graph_.nodes[static_cast<Index>(cell)];
    node.parent = parent;
    node.relation = Relation::kAdjacent;
    placed_[static_cast<Index>(cell)] = true;
    if (parent_role == PartRole::kForeground) {
      node.role = PartRole::kForeground;
      node.choice = RoleChoice{at_tip, PartRole::kSagittal, 0};
      return;
    }
    node.role = PartRole::kSagittal;
    const bool holds_limbs = std::any_of(parts_.parts.begin(), parts_.parts.end(),
                                         [&](const Part& p) { return p.over == cell; });
    const double side = holds_limbs ? -1 : side_cells_.OneOfAPair(cell, parent, OpenBehind(cell));
    node.choice = RoleChoice{0, PartRole::kForeground, side};
    if (side < 0) return;
    node.choice = RoleChoice{side, PartRole::kSagittal, 0};
    node.role = PartRole::kForeground;
    node.relation = Relation::kOver;
  }

  /// Open cells that can be reached from a cell through open cells.
  std::vector<int> OpenBehind(int cell) const {
    std::vector<int> found{cell};
    for (std::size_t k = 0; k < found.size(); ++k) {
      for (const auto& [other, length] : adjacency_.shared[static_cast<Index>(found[k])]) {
        if (IsOpen(static_cast<Index>(other)) &&
            std::find(found.begin(), found.end(), other) == found.end())
          found.push_back(other);
      }
    }
    found.erase(found.begin());
    return found;
  }

  /// Of two side cells alike and next to each other the lower one is near.
  void PairSideCells() {
    std::vector<int> sides;
    for (Index i = 0; i < placed_.size(); ++i) {
      const DepthNode& node = graph_.nodes[i];
      if (parts_.parts[i].kind == PartKind::kBorder && node.relation == Relation::kOver)
        sides.push_back(static_cast<int>(i));
    }
    struct Match {
      SideCells::Unlike unlike;
      int a = 0, b = 0;
    };
    std::vector<Match> matches;
    for (const int a : sides) {
      for (const int b : sides) {
        const auto parent = graph_.nodes[static_cast<Index>(a)].parent;
        if (a >= b || parent != graph_.nodes[static_cast<Index>(b)].parent) continue;
        if (const auto unlike = side_cells_.Unlikeness(a, b, *parent))
          matches.push_back({*unlike, a, b});
      }
    }
    std::stable_sort(matches.begin(), matches.end(), [](const Match& one, const Match& other) {
      return one.unlike.cost < other.unlike.cost;
    });
    for (const auto& [unlike, a, b] : matches) {
      const bool a_near = side_cells_.Lowest(a) >= side_cells_.Lowest(b);
      const int near = a_near ? a : b, far = a_near ? b : a;
      if (graph_.nodes[static_cast<Index>(near)].pair || graph_.nodes[static_cast<Index>(far)].pair)
        continue;
      graph_.nodes[static_cast<Index>(near)].pair = far;
      PutBehind(far, near, std::nullopt);
      graph_.nodes[static_cast<Index>(far)].choice =
          RoleChoice{unlike.score, PartRole::kForeground, 0};
    }
  }

  /// Makes a cell the far side of another, and what hangs on it further pieces of it.
  void PutBehind(int far, int near, std::optional<int> piece_of) {
    DepthNode& node = graph_.nodes[static_cast<Index>(far)];
    node.role = PartRole::kBackground;
    node.relation = Relation::kUnder;
    node.parent = graph_.nodes[static_cast<Index>(near)].parent;
    node.pair = near;
    node.piece_of = piece_of;
    for (Index i = 0; i < placed_.size(); ++i) {
      const DepthNode& child = graph_.nodes[i];
      if (child.parent == far && child.relation == Relation::kAdjacent)
        PutBehind(static_cast<int>(i), near, piece_of.value_or(far));
    }
  }

  const Parts& parts_;
  const Adjacency& adjacency_;
  DepthGraph& graph_;
  SideCells side_cells_;
  std::vector<bool> placed_;
};

}  // namespace

void PlaceCells(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
                DepthGraph& graph) {
  Placer(map, parts, adjacency, graph).Run();
}

}  // namespace lascaux

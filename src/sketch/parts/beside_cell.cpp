#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "sketch/parts/limb_cut.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Near and far limb, each seen from its root, point the same way within this angle ...
constexpr double kMostSwing = std::numbers::pi / 3;
/// Legs point down and ears up, at least this far from the horizontal: what runs on along the page
/// beside a cell is a jaw or a tail.
const double kLeastSlope = std::sin(35 * std::numbers::pi / 180);
/// A limb reaches this many times the width of its root.
constexpr double kLeastReach = 1.1;
/// Share of the diagonal: narrower is a hair.
constexpr double kLeastWidth = 0.012;
/// How far around, in lengths of the cell's own outline, the near limb may go.
constexpr double kMostWay = 1.5;
/// How far beyond the cell the near limb's root may begin, share of the diagonal.
constexpr double kCrotch = 0.04;
/// Steps of the search along the contour, share of the diagonal.
constexpr double kStep = 4e-3;
/// A turn of the contour that counts as a corner, and how much wider a root may be that ends there.
constexpr double kCorner = std::numbers::pi / 6, kCornerSlack = 1.25;

/// A stretch of the walk that the face shares with another cell.
struct SharedRun {
  double from = 0, length = 0;
};

/// Runs by the cell behind them; runs of one cell that are interrupted (a limb's tip between them)
/// stay apart, the longest is kept.
std::map<int, SharedRun> SharedRuns(const FaceView& face) {
  const auto behind = [&](std::size_t i) {
    const int h = PlanarMap::Twin(face.line.half_edges[i]);
    return face.map.cycle[static_cast<std::size_t>(h)];
  };
  const std::size_t n = face.line.half_edges.size();
  std::size_t start = 0;
  while (start < n && behind(start) == behind((start + n - 1) % n)) ++start;
  std::map<int, SharedRun> runs;
  if (start == n) return runs;
  for (std::size_t k = 0; k < n;) {
    const std::size_t first = (start + k) % n;
    const int cell = behind(first);
    std::size_t count = 0;
    while (k + count < n && behind((first + count) % n) == cell) ++count;
    k += count;
    if (face.map.cycles[static_cast<std::size_t>(cell)].kind != CycleKind::kBorder) continue;
    const double from = face.line.arcs[first];
    const std::size_t after = (first + count) % n;
    const double length = face.line.Ahead(from, face.line.arcs[after]);
    if (length > runs[cell].length) runs[cell] = {from, length};
  }
  return runs;
}

/// Seen from its root: where the tip is.
struct Reach {
  Vector2d root, tip;
  double Length() const { return (tip - root).norm(); }
};

Reach ReachOf(const Polyline& points, const Vector2d& root) {
  const auto tip =
      std::max_element(points.begin(), points.end(), [&](const Vector2d& a, const Vector2d& b) {
        return (a - root).squaredNorm() < (b - root).squaredNorm();
      });
  return {root, *tip};
}

Polyline RingOf(const PlanarMap& map, int cycle) {
  Polyline ring;
  for (const int h : map.cycles[static_cast<std::size_t>(cycle)].half_edges)
    Append(ring, map.Points(h));
  return ring;
}

bool IsInsideFace(const FaceView& face, const Vector2d& a, const Vector2d& b) {
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    if (!Contains(face.line.points, a + share * (b - a))) return false;
  }
  return true;
}

/// The walk in one direction: `sign` +1 ahead, -1 back.
struct Way {
  const FaceView& face;
  double start = 0;
  int sign = 1;

  Vector2d At(double s) const { return face.line.At(start + sign * s); }
};

/// A stretch of the walk, `from` to `to` along a Way, that may be a limb beside a cell.
struct Bump {
  double from = 0, to = 0;
  double cost = std::numeric_limits<double>::infinity();
};

/// A cell behind the face. What they share is its joint if the cell reaches farther away from it
/// than it is long; else it runs along the limb, and the far limb's root is hidden.
struct Cell {
  Polyline ring;
  std::optional<Vector2d> joint;
};

Cell CellBehind(const FaceView& face, int cycle, const SharedRun& run) {
  Cell cell{RingOf(face.map, cycle), {}};
  const Vector2d middle = face.line.At(run.from + 0.5 * run.length);
  if (ReachOf(cell.ring, middle).Length() > run.length) cell.joint = middle;
  return cell;
}

/// How unlike the bump between two places is to the cell, as limbs; infinite if it is none.
double Unlike(const Way& way, const Polyline& contour,
              const std::pair<std::size_t, std::size_t>& at, const Cell& cell) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vector2d a = contour[at.first], b = contour[at.second];
  const double width = (a - b).norm(), diagonal = way.face.map.diagonal;
  if (width < kLeastWidth * diagonal) return kNever;
  const Vector2d root = 0.5 * (a + b);
  const Polyline own(contour.begin() + static_cast<std::ptrdiff_t>(at.first),
                     contour.begin() + static_cast<std::ptrdiff_t>(at.second) + 1);
  const Reach near = ReachOf(own, root);
  if (near.Length() < kLeastReach * width) return kNever;
  const double slope = std::abs((near.tip - near.root).y()) / near.Length();
  if (slope < kLeastSlope) return kNever;
  const Reach far = ReachOf(cell.ring, cell.joint.value_or(root));
  const double swing = AngleBetween(near.tip - near.root, far.tip - far.root);
  if (swing > kMostSwing) return kNever;
  const double longer = std::abs(std::log(near.Length() / far.Length()));
  const double bulk =
      std::abs(std::log(std::abs(SignedArea(own)) / std::abs(SignedArea(cell.ring))));
  // A far limb is partly hidden: its bulk says less than its length.
  return swing + 1.5 * longer + 0.25 * bulk + 0.5 * width / near.Length();
}

/// The bump next to a shared run whose root begins in the run and ends beyond it.
Bump BestBump(const Way& way, double run, const Cell& cell) {
  const double step = kStep * way.face.map.diagonal;
  const double most = std::min(run + kMostWay * Length(cell.ring), 0.6 * way.face.line.length);
  Polyline contour;
  for (double s = 0; s < most; s += step) contour.push_back(way.At(s));
  Bump best;
  const std::size_t begin = static_cast<std::size_t>(run / step) + 1;
  // The crotch may lie a little beyond the far limb's corner.
  const std::size_t last = begin + static_cast<std::size_t>(kCrotch / kStep);
  const std::size_t stride = std::max<std::size_t>(1, begin / 24);
  for (std::size_t i = 0; i <= last; i += stride) {
    // The second end lies where the contour comes nearest to the first beyond the tip.
    double farthest = 0, nearest = std::numeric_limits<double>::infinity();
    std::size_t place = 0;
    for (std::size_t k = std::max(begin, i) + 1; k < contour.size(); ++k) {
      const double d = (contour[k] - contour[i]).norm();
      if (d > farthest) {
        if (nearest < farthest / kLeastReach) break;
        farthest = d;
        nearest = std::numeric_limits<double>::infinity();
      } else if (d < nearest) {
        nearest = d;
        place = k;
      } else if (d > 1.6 * nearest && nearest < farthest / kLeastReach) {
        break;
      }
    }
    if (place == 0 || nearest > farthest / kLeastReach) continue;
    if (!IsInsideFace(way.face, contour[i], contour[place])) continue;
    const double cost = Unlike(way, contour, {i, place}, cell);
    if (cost < best.cost)
      best = {static_cast<double>(i) * step, static_cast<double>(place) * step, cost};
  }
  return best;
}

/// The sharpest corner near the bump's second end that does not widen its root much.
double MovedToCorner(const Way& way, const Bump& bump, double step) {
  const Vector2d origin = way.At(bump.from);
  const double width = (way.At(bump.to) - origin).norm(), reach = 3 * step;
  double best = bump.to, sharpest = kCorner;
  for (double s = bump.to - 0.5 * width; s < bump.to + 0.5 * width; s += step) {
    if ((way.At(s) - origin).norm() > kCornerSlack * width) continue;
    const double turn = AngleBetween(way.At(s) - way.At(s - reach), way.At(s + reach) - way.At(s));
    if (turn > sharpest) {
      sharpest = turn;
      best = s;
    }
  }
  return best;
}

std::optional<LimbCut> CutOf(const Way& way, const Bump& bump) {
  const FaceView& face = way.face;
  const double step = kStep * face.map.diagonal, to = MovedToCorner(way, bump, step);
  const Vector2d a = way.At(bump.from), b = way.At(to);
  if (!IsInsideFace(face, a, b)) return std::nullopt;
  const double from = face.line.Wrap(way.start + way.sign * bump.from),
               end = face.line.Wrap(way.start + way.sign * to);
  auto limb = way.sign > 0 ? CutAcross(face, from, end) : CutAcross(face, end, from);
  if (!limb) return std::nullopt;
  limb->evidence = LimbEvidence::kFarSide;
  limb->energy = bump.cost;
  limb->score = 1 - bump.cost / kMostUnlikeFarSide;
  return limb;
}

/// True when an island lies in a ring: an eye makes it a head.
bool HoldsAnIsland(const FaceView& face, const Polyline& ring) {
  return std::any_of(face.map.cycles.begin(), face.map.cycles.end(), [&](const MapCycle& cycle) {
    return cycle.kind == CycleKind::kIsland &&
           Contains(
               ring,
               face.map.nodes[static_cast<std::size_t>(face.map.Origin(cycle.half_edges.front()))]
                   .position);
  });
}

/// True when two stretches of the walk have a place in common.
bool Overlap(const BoundaryLine& line, double from, double to, const LimbCut& limb) {
  return line.Ahead(from, limb.from) <= line.Ahead(from, to) ||
         line.Ahead(limb.from, from) <= line.Ahead(limb.from, limb.to);
}

}  // namespace

std::vector<LimbCut> LimbsBesideCells(const FaceView& face, const std::vector<LimbCut>& known) {
  struct Candidate {
    Bump bump;
    Way way;
  };
  std::vector<LimbCut> found;
  const auto is_free = [&](double from, double to) {
    const auto clear = [&](const LimbCut& limb) { return !Overlap(face.line, from, to, limb); };
    return std::all_of(known.begin(), known.end(), clear) &&
           std::all_of(found.begin(), found.end(), clear);
  };
  for (const auto& [cell, run] : SharedRuns(face)) {
    const double end = face.line.Wrap(run.from + run.length);
    if (!is_free(run.from, end)) continue;  // the limb in front of this cell is known
    const Cell far = CellBehind(face, cell, run);
    if (HoldsAnIsland(face, far.ring)) continue;
    std::optional<LimbCut> best;
    for (const Way& way : {Way{face, run.from, 1}, Way{face, end, -1}}) {
      const Bump bump = BestBump(way, run.length, far);
      if (bump.cost > kMostUnlikeFarSide || (best && best->energy <= bump.cost)) continue;
      const auto limb = CutOf(way, bump);
      if (!limb || !is_free(limb->from, limb->to)) continue;
      if (!HoldsAnIsland(face, Stretch(face.line, limb->from, limb->to).points)) best = limb;
    }
    if (best) found.push_back(std::move(*best));
  }
  return found;
}

}  // namespace lascaux

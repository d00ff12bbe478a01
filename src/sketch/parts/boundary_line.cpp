#include "sketch/parts/boundary_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lascaux {

using Eigen::Vector2d;

namespace {

constexpr double kTangentReach = 0.012;
/// A path nearer to the boundary than this share of the diagonal runs along it: strokes drawn twice
/// differ by about a pen's width.
constexpr double kAlongside = 7e-3;
/// Turns that tell a path along the boundary: back over it on one side, no limb's edge running on
/// into it on the other.
constexpr double kBack = 150 * std::numbers::pi / 180, kRunsOn = std::numbers::pi / 4;

/// Index of the piece that holds a place in [0, length).
std::size_t PieceAt(const BoundaryLine& line, double arc) {
  const auto after = std::upper_bound(line.arcs.begin(), line.arcs.end(), arc);
  return static_cast<std::size_t>(after - line.arcs.begin()) - 1;
}

}  // namespace

std::pair<double, double> NearestPlace(const BoundaryLine& line, const Vector2d& point) {
  std::pair<double, double> best{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const std::size_t next = (i + 1) % line.points.size();
    const double t = NearestParameter(line.points[i], line.points[next], point);
    const Vector2d step = line.points[next] - line.points[i];
    const double distance = (line.points[i] + t * step - point).norm();
    if (distance < best.second) best = {line.arcs[i] + t * step.norm(), distance};
  }
  return best;
}

namespace {

/// True when a curve begins along the boundary, and not because a limb's edge runs on into it at a
/// flat angle.
bool BeginsAlongside(const SuggestiveCurve& curve) {
  return std::max(curve.turn_before, curve.turn_after) > kBack &&
         std::min(curve.turn_before, curve.turn_after) > kRunsOn;
}

/// Cuts off the beginning of a path that runs along the boundary.
void Reroot(const BoundaryLine& line, double alongside, SuggestiveCurve& curve) {
  const double length = Length(curve.points), step = 0.5 * alongside;
  double along = 0;
  for (double s = step;
       s < length && NearestPlace(line, PointAtLength(curve.points, s)).second < alongside;
       s += step)
    along = s;
  // Every path is near the boundary at first, longer so the flatter it leaves.
  if (along < 4 * alongside || along > length - 4 * alongside) return;
  curve.arc = line.Wrap(NearestPlace(line, PointAtLength(curve.points, along)).first);
  curve.points = Section(curve.points, along, length);
  curve.points.front() = line.At(curve.arc);
}

void Measure(const BoundaryLine& line, double reach, SuggestiveCurve& curve) {
  curve.length = Length(curve.points);
  curve.departure = DepartureDirection(curve.points, reach);
  curve.tip = ArrivalDirection(curve.points, reach);
  const Vector2d before = line.DirectionBefore(curve.arc, reach),
                 after = line.DirectionAfter(curve.arc, reach);
  curve.turn_before = AngleBetween(before, curve.departure);
  curve.turn_after = AngleBetween(-after, curve.departure);
  curve.turn_through = AngleBetween(before, after);
}

}  // namespace

double TangentReach(const PlanarMap& map) { return kTangentReach * map.diagonal; }

std::vector<SuggestiveCurve> SuggestiveCurvesOf(const PlanarMap& map, const Boundary& boundary,
                                                const BoundaryLine& line) {
  std::vector<SuggestiveCurve> curves;
  for (const DanglingPath& path : boundary.paths) {
    SuggestiveCurve curve;
    curve.points = path.points;
    curve.edges = path.edges;
    curve.arc = line.node_arcs[static_cast<std::size_t>(path.position)];
    Measure(line, TangentReach(map), curve);
    if (BeginsAlongside(curve)) {
      Reroot(line, kAlongside * map.diagonal, curve);
      Measure(line, TangentReach(map), curve);
    }
    curves.push_back(std::move(curve));
  }
  std::stable_sort(
      curves.begin(), curves.end(),
      [](const SuggestiveCurve& a, const SuggestiveCurve& b) { return a.arc < b.arc; });
  return curves;
}

double BoundaryLine::Wrap(double arc) const {
  arc = std::fmod(arc, length);
  return arc < 0 ? arc + length : arc;
}

Vector2d BoundaryLine::At(double arc) const {
  arc = Wrap(arc);
  const std::size_t i = PieceAt(*this, arc), next = (i + 1) % points.size();
  const double end = next == 0 ? length : arcs[next];
  const double share = end > arcs[i] ? (arc - arcs[i]) / (end - arcs[i]) : 0;
  return points[i] + share * (points[next] - points[i]);
}

Vector2d BoundaryLine::DirectionBefore(double arc, double reach) const {
  const Vector2d d = At(arc) - At(arc - reach);
  return d.isZero(0) ? d : d.stableNormalized();
}

Vector2d BoundaryLine::DirectionAfter(double arc, double reach) const {
  const Vector2d d = At(arc + reach) - At(arc);
  return d.isZero(0) ? d : d.stableNormalized();
}

BoundaryLine LineOf(const PlanarMap& map, const Boundary& boundary) {
  BoundaryLine line;
  for (const int h : boundary.half_edges) {
    line.node_arcs.push_back(line.length);
    const Polyline points = map.Points(h);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      line.points.push_back(points[k]);
      line.half_edges.push_back(h);
      line.arcs.push_back(line.length);
      line.length += (points[k + 1] - points[k]).norm();
    }
  }
  return line;
}

BoundaryStretch Stretch(const BoundaryLine& line, double from, double to) {
  from = line.Wrap(from);
  const double ahead = line.Ahead(from, to);
  BoundaryStretch stretch;
  stretch.points.push_back(line.At(from));
  std::size_t i = PieceAt(line, from);
  double walked = 0;
  // Pieces of rounding length would be points in a row at one place.
  const double tiny = 1e-9 * line.length;
  while (true) {
    const std::size_t next = (i + 1) % line.points.size();
    const double end = next == 0 ? line.length : line.arcs[next];
    walked = line.Ahead(from, line.Wrap(end));
    if (walked == 0) walked = line.length;
    if (walked >= ahead - tiny) break;
    if (walked > tiny) {
      stretch.points.push_back(line.points[next]);
      stretch.half_edges.push_back(line.half_edges[i]);
    }
    i = next;
  }
  stretch.points.push_back(line.At(to));
  stretch.half_edges.push_back(line.half_edges[i]);
  return stretch;
}

}  // namespace lascaux

#include "sketch/parts/boundary_line.h"

#include <algorithm>
#include <cmath>

namespace lascaux {

using Eigen::Vector2d;

namespace {

/// Index of the piece that holds a place in [0, length).
std::size_t PieceAt(const BoundaryLine& line, double arc) {
  const auto after = std::upper_bound(line.arcs.begin(), line.arcs.end(), arc);
  return static_cast<std::size_t>(after - line.arcs.begin()) - 1;
}

}  // namespace

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

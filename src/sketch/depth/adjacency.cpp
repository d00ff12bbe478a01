#include "sketch/depth/adjacency.h"

#include <algorithm>
#include <limits>

#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A stretch of a parent's outline between two limbs, as half-edges in walk order.
using Run = std::vector<int>;

/// The parent's half-edges cut where the walk jumps: there a limb was taken out.
std::vector<Run> RunsOf(const PlanarMap& map, const Part& parent) {
  std::vector<Run> runs;
  for (const int h : parent.half_edges) {
    const bool goes_on = !runs.empty() && map.Target(runs.back().back()) == map.Origin(h);
    if (!goes_on) runs.push_back({});
    runs.back().push_back(h);
  }
  // The list begins anywhere: its last run may go on in its first.
  if (runs.size() > 1 && map.Target(runs.back().back()) == map.Origin(runs.front().front())) {
    runs.back().insert(runs.back().end(), runs.front().begin(), runs.front().end());
    runs.erase(runs.begin());
  }
  return runs;
}

double DistanceTo(const PlanarMap& map, int half_edge, const Vector2d& point) {
  double best = std::numeric_limits<double>::infinity();
  const Polyline& line = map.edges[static_cast<std::size_t>(half_edge / 2)].points;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const double t = NearestParameter(line[k], line[k + 1], point);
    best = std::min(best, (line[k] + t * (line[k + 1] - line[k]) - point).norm());
  }
  return best;
}

}  // namespace

Adjacency AdjacencyOf(const PlanarMap& map, const Parts& parts) {
  Adjacency result;
  result.owner.assign(map.next.size(), -1);
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    for (const int h : parts.parts[i].half_edges) {
      int& owner = result.owner[static_cast<std::size_t>(h)];
      const bool limb = parts.parts[i].kind == PartKind::kLimb;
      if (owner < 0 || limb) owner = static_cast<int>(i);
    }
  }
  result.shared.resize(parts.parts.size());
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    for (const int h : parts.parts[i].half_edges) {
      const int other = result.owner[static_cast<std::size_t>(PlanarMap::Twin(h))];
      if (other < 0 || other == static_cast<int>(i)) continue;
      result.shared[i][other] += Length(map.edges[static_cast<std::size_t>(h / 2)].points);
    }
  }
  return result;
}

std::optional<Vector2d> MiddleOfShared(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
                                       const std::pair<int, int>& pair) {
  Vector2d sum = Vector2d::Zero();
  double total = 0;
  for (const int h : parts.parts[static_cast<std::size_t>(pair.first)].half_edges) {
    if (adjacency.owner[static_cast<std::size_t>(PlanarMap::Twin(h))] != pair.second) continue;
    const Polyline& line = map.edges[static_cast<std::size_t>(h / 2)].points;
    const double length = Length(line);
    sum += length * PointAtLength(line, 0.5 * length);
    total += length;
  }
  return total > 0 ? std::optional<Vector2d>(sum / total) : std::nullopt;
}

std::vector<int> March(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency, int limb) {
  const Part& part = parts.parts[static_cast<std::size_t>(limb)];
  const Part& parent = parts.parts[static_cast<std::size_t>(*part.over)];
  const std::vector<Run> runs = RunsOf(map, parent);
  std::vector<int> met;
  const auto look_at = [&](int h) {
    const int other = adjacency.owner[static_cast<std::size_t>(PlanarMap::Twin(h))];
    if (other >= 0 && std::find(met.begin(), met.end(), other) == met.end()) met.push_back(other);
  };
  // The walk reaches the limb at closed[0], the last half-edge of a run, and leaves it at closed[1], the first of a run.
  for (const Run& run : runs) {
    const double tolerance = 1e-3 * map.diagonal;
    const bool leaves = DistanceTo(map, run.front(), part.root->closed[1]) < tolerance;
    const bool arrives = DistanceTo(map, run.back(), part.root->closed[0]) < tolerance;
    if (!leaves && !arrives) continue;
    for (const int h : run) look_at(h);
  }
  return met;
}

Vector2d Centroid(const std::vector<Vector2d>& ring) {
  Vector2d sum = Vector2d::Zero();
  double area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double a = Cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
    sum += a / 3 * (ring[i] + ring[i + 1] + ring[0]);
    area += a;
  }
  return area != 0 ? Vector2d(sum / area) : ring.front();
}

}  // namespace lascaux

#include "sketch/depth/adjacency.h"

#include <algorithm>
#include <limits>

#include "sketch/map/polyline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

std::vector<int> HalfEdgesOf(const Part& part) {
  std::vector<int> all;
  for (const std::vector<int>& stretch : part.stretches)
    all.insert(all.end(), stretch.begin(), stretch.end());
  return all;
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
    for (const int h : HalfEdgesOf(parts.parts[i])) {
      int& owner = result.owner[static_cast<std::size_t>(h)];
      const bool limb = parts.parts[i].kind == PartKind::kLimb;
      if (owner < 0 || limb) owner = static_cast<int>(i);
    }
  }
  result.shared.resize(parts.parts.size());
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    for (const int h : HalfEdgesOf(parts.parts[i])) {
      const int other = result.owner[static_cast<std::size_t>(PlanarMap::Twin(h))];
      if (other < 0 || other == static_cast<int>(i)) continue;
      result.shared[i][other] += Length(map.edges[static_cast<std::size_t>(h / 2)].points);
    }
  }
  return result;
}

std::optional<Vector2d> MiddleOfShared(const PlanarMap& map, const Parts& parts,
                                       const Adjacency& adjacency,
                                       const std::pair<int, int>& pair) {
  Vector2d sum = Vector2d::Zero();
  double total = 0;
  for (const int h : HalfEdgesOf(parts.parts[static_cast<std::size_t>(pair.first)])) {
    if (adjacency.owner[static_cast<std::size_t>(PlanarMap::Twin(h))] != pair.second) continue;
    const Polyline& line = map.edges[static_cast<std::size_t>(h / 2)].points;
    const double length = Length(line);
    sum += length * PointAtLength(line, 0.5 * length);
    total += length;
  }
  return total > 0 ? std::optional<Vector2d>(sum / total) : std::nullopt;
}

std::vector<int> March(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
                       int limb) {
  const Part& part = parts.parts[static_cast<std::size_t>(limb)];
  const Part& parent = parts.parts[static_cast<std::size_t>(*part.over)];
  std::vector<int> met;
  const auto look_at = [&](int h) {
    const int other = adjacency.owner[static_cast<std::size_t>(PlanarMap::Twin(h))];
    if (other >= 0 && std::find(met.begin(), met.end(), other) == met.end()) met.push_back(other);
  };
  // The parent's walk reaches the limb at closed[0], where a stretch ends, and leaves it at
  // closed[1], where one begins.
  const double tolerance = 1e-3 * map.diagonal;
  for (const std::vector<int>& run : parent.stretches) {
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

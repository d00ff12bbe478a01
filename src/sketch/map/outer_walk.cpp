#include "sketch/map/outer_walk.h"

#include <algorithm>
#include <cmath>

#include "sketch/map/polyline.h"

namespace lascaux {

using Eigen::Vector2d;

double OuterWalk::FaceArea(std::size_t i, std::size_t j) const {
  if (i > j) std::swap(i, j);
  const Vector2d origin = points.front().position;
  const double bridge = Cross(points[j].position - origin, points[i].position - origin);
  const double one = points[j].double_area - points[i].double_area + bridge;
  return 0.5 * std::max(one, double_area - one);
}

double OuterWalk::Along(std::size_t i, std::size_t j) const {
  const double d = std::abs(points[i].arc - points[j].arc);
  return std::min(d, length - d);
}

std::vector<OuterWalk> OuterWalks(const PlanarMap& map, double spacing) {
  std::vector<OuterWalk> walks;
  for (const MapCycle& cycle : map.cycles) {
    if (cycle.kind != CycleKind::kOuter) continue;
    OuterWalk walk;
    for (const int h : cycle.half_edges) {
      const std::vector<Vector2d> line = map.Points(h);
      const bool begins_at_tip =
          map.nodes[static_cast<std::size_t>(map.Origin(h))].outgoing.size() == 1;
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const int pieces =
            std::max(1, static_cast<int>(std::ceil((line[k + 1] - line[k]).norm() / spacing)));
        for (int i = 0; i < pieces; ++i) {
          const Vector2d p = line[k] + (static_cast<double>(i) / pieces) * (line[k + 1] - line[k]);
          walk.points.push_back({p, h, begins_at_tip && k == 0 && i == 0, 0, 0});
        }
      }
    }
    const Vector2d origin = walk.points.front().position;
    for (std::size_t k = 1; k < walk.points.size(); ++k) {
      WalkPoint& p = walk.points[k];
      const WalkPoint& before = walk.points[k - 1];
      p.arc = before.arc + (p.position - before.position).norm();
      p.double_area = before.double_area + Cross(before.position - origin, p.position - origin);
    }
    walk.double_area = walk.points.back().double_area;
    walk.length = walk.points.back().arc + (walk.points.back().position - origin).norm();
    walks.push_back(std::move(walk));
  }
  return walks;
}

}  // namespace lascaux

#include "volume/measure/outline.h"

#include <cstddef>

#include "volume/edges.h"

namespace lascaux {

using Eigen::Vector2d;

Eigen::AlignedBox2d Outline::Box() const {
  Eigen::AlignedBox2d box;
  for (const OutlineEdge& e : edges) box.extend(e.a).extend(e.b);
  return box;
}

Outline OutlineOf(const Mesh& mesh) {
  const auto at = [&](std::uint32_t v) -> Vector2d {
    return mesh.vertices[v].head<2>().cast<double>();
  };
  std::vector<std::int8_t> turn(mesh.triangles.size());  // 1 for counter-clockwise, -1, or 0
  for (std::size_t t = 0; t < turn.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Vector2d u = at(j) - at(i), v = at(k) - at(i);
    const double area = u.x() * v.y() - u.y() * v.x();
    turn[t] = static_cast<std::int8_t>((area > 0) - (area < 0));
  }
  Outline outline;
  EdgeTable(mesh).ForEdges([&](std::uint32_t low, std::span<const EdgeSide> sides) {
    int winding = 0;
    for (const EdgeSide& s : sides) {
      const bool forward = mesh.triangles[s.Triangle()][s.side % 3] == low;
      winding += forward ? turn[s.Triangle()] : -turn[s.Triangle()];
    }
    if (winding != 0) outline.edges.push_back({at(low), at(sides.front().high), winding, 0});
  });
  return outline;
}

Outline OutlineOf(const std::vector<std::vector<Vector2d>>& rings) {
  Outline outline;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Vector2d& next = rings[r][i + 1 == rings[r].size() ? 0 : i + 1];
      outline.edges.push_back({rings[r][i], next, 1, static_cast<std::uint32_t>(r)});
    }
  }
  return outline;
}

}  // namespace lascaux

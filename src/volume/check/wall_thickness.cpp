#include "lascaux/volume/wall_thickness.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "volume/arena.h"
#include "volume/check/triangle_grid.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool IsValid(const Mesh& mesh) {
  for (const Eigen::Vector3f& v : mesh.vertices)
    if (!v.allFinite()) return false;
  for (const auto& t : mesh.triangles)
    if (*std::max_element(t.begin(), t.end()) >= mesh.vertices.size()) return false;
  return true;
}

/// From the middle of a triangle straight inward; infinitely thick where nothing is nearer than the
/// limit.
Wall WallAt(const TriangleGrid& grid, std::size_t i, const std::atomic<double>& limit) {
  const Triangle& t = grid.triangles()[i];
  Wall wall;
  wall.thickness = kInfinity;
  wall.triangle = static_cast<std::uint32_t>(i);
  if (t.normal.isZero()) return wall;
  const Vector3d middle = t.a + (t.ab + t.ac) / 3;
  wall.thickness = grid.Shoot(i, middle, -t.normal, limit).distance;
  if (wall.thickness < kInfinity) wall.middle = middle - wall.thickness / 2 * t.normal;
  return wall;
}

/// The thinner one, of equals the one with the smaller index: the same in any order.
Wall Thinner(const Wall& a, const Wall& b) {
  if (a.thickness != b.thickness) return a.thickness < b.thickness ? a : b;
  return a.triangle <= b.triangle ? a : b;
}

}  // namespace

std::optional<Wall> SmallestWall(const Mesh& mesh, const Execution& execution) {
  if (!IsValid(mesh) || mesh.triangles.empty()) return std::nullopt;
  const TriangleGrid grid(mesh);
  std::atomic<double> limit = kInfinity;
  Wall none;
  none.thickness = kInfinity;
  const auto shoot = [&](const tbb::blocked_range<std::size_t>& range, Wall best) {
    for (std::size_t i = range.begin(); i < range.end() && !execution.IsCancelled(); ++i) {
      const Wall wall = WallAt(grid, i, limit);
      if (!(wall.thickness < kInfinity)) continue;
      best = Thinner(best, wall);
      double known = limit.load(std::memory_order_relaxed);
      while (wall.thickness < known && !limit.compare_exchange_weak(known, wall.thickness)) {
      }
    }
    return best;
  };
  Wall best = none;
  RunInArena(execution, [&] {
    best = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), 256),
                                none, shoot, Thinner);
  });
  if (!(best.thickness < kInfinity)) return std::nullopt;
  return best;
}

std::vector<Wall> FindThinWalls(const Mesh& mesh, double limit, const Execution& execution) {
  if (!IsValid(mesh) || mesh.triangles.empty()) return {};
  const TriangleGrid grid(mesh);
  const std::atomic<double> farthest = limit;
  std::vector<Wall> walls(mesh.triangles.size());
  RunInArena(execution, [&] {
    tbb::parallel_for(std::size_t{0}, walls.size(),
                      [&](std::size_t i) { walls[i] = WallAt(grid, i, farthest); });
  });
  std::erase_if(walls, [limit](const Wall& wall) { return !(wall.thickness < limit); });
  return walls;
}

}  // namespace lascaux

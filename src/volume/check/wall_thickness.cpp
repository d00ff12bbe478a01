#include "lascaux/volume/wall_thickness.h"

#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lascaux/base/arena.h"
#include "volume/check/thin_regions.h"
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
  const Vector3d& normal = grid.normal(i);
  Wall wall;
  wall.thickness = kInfinity;
  wall.triangle = static_cast<std::uint32_t>(i);
  if (normal.isZero()) return wall;
  const Vector3d middle = grid.triangle(i).Middle();
  wall.thickness = grid.Shoot(i, middle, -normal, limit).distance;
  if (wall.thickness < kInfinity) wall.middle = middle - wall.thickness / 2 * normal;
  return wall;
}

/// The thinner one, of equals the one with the smaller index: the same in any order.
bool IsThinner(const Wall& a, const Wall& b) {
  return a.thickness != b.thickness ? a.thickness < b.thickness : a.triangle < b.triangle;
}

/// Walls thinner than `limit`, by triangles, and the smallest one: of those below `farthest`, which
/// is not below the limit.
struct FoundWalls {
  std::vector<Wall> thin;
  std::optional<Wall> smallest;
};

FoundWalls LookFor(const TriangleGrid& grid, double limit, double farthest,
                   const Execution& execution) {
  std::atomic<double> reach = farthest;
  tbb::combinable<FoundWalls> parts;
  const auto look = [&](std::size_t i) {
    if (execution.IsCancelled()) return;
    const Wall wall = WallAt(grid, i, reach);
    if (!(wall.thickness < farthest)) return;
    FoundWalls& found = parts.local();
    if (wall.thickness < limit) found.thin.push_back(wall);
    if (!found.smallest || IsThinner(wall, *found.smallest)) found.smallest = wall;
    const double enough = std::max(limit, wall.thickness);
    double known = reach.load(std::memory_order_relaxed);
    while (enough < known && !reach.compare_exchange_weak(known, enough)) {
    }
  };
  // Some of them from all over the mesh tell how far the others have to look.
  constexpr std::size_t kFirst = 32;
  tbb::parallel_for(std::size_t{0}, (grid.size() + kFirst - 1) / kFirst,
                    [&](std::size_t i) { look(kFirst * i); });
  tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t i) {
    if (i % kFirst != 0) look(i);
  });
  FoundWalls all;
  parts.combine_each([&](const FoundWalls& found) {
    all.thin.insert(all.thin.end(), found.thin.begin(), found.thin.end());
    if (found.smallest && (!all.smallest || IsThinner(*found.smallest, *all.smallest)))
      all.smallest = found.smallest;
  });
  std::sort(all.thin.begin(), all.thin.end(),
            [](const Wall& a, const Wall& b) { return a.triangle < b.triangle; });
  return all;
}

}  // namespace

std::optional<Wall> SmallestWall(const Mesh& mesh, const Execution& execution) {
  if (!IsValid(mesh) || mesh.triangles.empty()) return std::nullopt;
  FoundWalls found;
  RunInArena(execution, [&] { found = LookFor(TriangleGrid(mesh), 0, kInfinity, execution); });
  return found.smallest;
}

std::vector<Wall> FindThinWalls(const Mesh& mesh, double limit, const Execution& execution) {
  if (!IsValid(mesh) || mesh.triangles.empty()) return {};
  FoundWalls found;
  RunInArena(execution, [&] { found = LookFor(TriangleGrid(mesh), limit, limit, execution); });
  return std::move(found.thin);
}

WallFacts MeasureWalls(const Mesh& mesh, double limit, const Execution& execution) {
  WallFacts facts;
  if (!IsValid(mesh) || mesh.triangles.empty()) return facts;
  RunInArena(execution, [&] {
    const TriangleGrid grid(mesh);
    const FoundWalls found = LookFor(grid, limit, kInfinity, execution);
    facts.smallest = found.smallest;
    facts.thin = TellThinPlaces(mesh, found.thin, limit, grid);
  });
  return facts;
}

}  // namespace lascaux

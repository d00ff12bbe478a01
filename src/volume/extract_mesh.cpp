#include "lascaux/volume/extract_mesh.h"

#include <fmt/format.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <optional>
#include <vector>

#include "volume/arena.h"
#include "volume/shells.h"
#include "volume/write_grid.h"

namespace lascaux {
namespace {

using Grid = openvdb::FloatGrid;

/// Is an active value so close to 0 that vertices could fall on one point?
bool HasTinyValues(const Grid& grid, float least) {
  std::atomic<bool> found = false;
  openvdb::tree::LeafManager<const openvdb::FloatTree> leaves(grid.tree());
  leaves.foreach ([&](const openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    for (auto value = leaf.cbeginValueOn(); value; ++value) {
      if (std::abs(*value) < least) {
        found.store(true, std::memory_order_relaxed);
        return;
      }
    }
  });
  return found;
}

Grid::Ptr WithoutTinyValues(const Grid& grid, float least) {
  Grid::Ptr copy = grid.deepCopy();
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(copy->tree());
  leaves.foreach ([&](openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    for (auto value = leaf.beginValueOn(); value; ++value) {
      if (std::abs(*value) < least) value.setValue(*value < 0 ? -least : least);
    }
  });
  return copy;
}

Mesh ToTriangles(const std::vector<openvdb::Vec3s>& points,
                 const std::vector<openvdb::Vec4I>& quads) {
  Mesh mesh;
  mesh.vertices.resize(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    mesh.vertices[i] = {points[i].x(), points[i].y(), points[i].z()};
  });
  mesh.triangles.resize(2 * quads.size());
  tbb::parallel_for(std::size_t{0}, quads.size(), [&](std::size_t i) {
    const openvdb::Vec4I& q = quads[i];
    const auto diagonal = [&](int a, int b) { return (points[q[a]] - points[q[b]]).lengthSqr(); };
    // Clockwise corners, taken backwards.
    if (diagonal(0, 2) <= diagonal(1, 3)) {
      mesh.triangles[2 * i] = {q[0], q[2], q[1]};
      mesh.triangles[2 * i + 1] = {q[0], q[3], q[2]};
    } else {
      mesh.triangles[2 * i] = {q[0], q[3], q[1]};
      mesh.triangles[2 * i + 1] = {q[1], q[3], q[2]};
    }
  });
  return mesh;
}

Mesh Extract(const Grid& grid) {
  const float least = kLeastDistance * static_cast<float>(grid.voxelSize().x());
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  // The next smaller float: distances that were written as the least must not cause a copy.
  if (HasTinyValues(grid, std::nextafter(least, 0.0F))) {
    openvdb::tools::volumeToMesh(*WithoutTinyValues(grid, least), points, quads, 0.0);
  } else {
    openvdb::tools::volumeToMesh(grid, points, quads, 0.0);
  }
  return ToTriangles(points, quads);
}

}  // namespace

Outcome<Mesh> ExtractMesh(const openvdb::FloatGrid& grid, const Execution& execution) {
  using Result = Outcome<Mesh>;
  const auto cancelled = [] {
    return Error(FailureKind::kInterrupted, "cancelled", "the run was stopped");
  };
  if (execution.IsCancelled()) return Result::Failure(cancelled());
  try {
    std::optional<Result> result;
    RunInArena(execution, [&] { result = KeepLargestShell(Extract(grid)); });
    if (execution.IsCancelled()) return Result::Failure(cancelled());
    return std::move(*result);
  } catch (const std::bad_alloc&) {
    return Result::Failure(Error(
        FailureKind::kUsage, "out-of-memory",
        fmt::format("a mesh of {} active voxels does not fit in memory: ask for larger voxels",
                    grid.activeVoxelCount())));
  }
}

}  // namespace lascaux

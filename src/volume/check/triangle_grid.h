#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "lascaux/volume/mesh.h"

namespace lascaux {

struct Triangle {
  Eigen::Vector3d a, ab, ac;

  Triangle(const Mesh& mesh, std::size_t i) {
    const auto& t = mesh.triangles[i];
    a = mesh.vertices[t[0]].cast<double>();
    ab = mesh.vertices[t[1]].cast<double>() - a;
    ac = mesh.vertices[t[2]].cast<double>() - a;
  }

  Eigen::Vector3d Middle() const { return a + (ab + ac) / 3; }
};

/// Where a ray ends.
struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = 0;
};

/// Triangles in the cells of a uniform grid that their boxes touch.
class TriangleGrid {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  /// Cosine: sides within 60 degrees of facing each other are walls.
  static constexpr double kFacing = -0.5;
  static constexpr int kMostCells = 256;       ///< along the longest side
  static constexpr double kLargest = 1 << 23;  ///< cells in all
  /// A surface meets about 2 k^2 of k^3 cells: so many triangles have their middle in each.
  static constexpr double kTrianglesACell = 6;

 public:
  /// The mesh must outlive the grid.
  explicit TriangleGrid(const Mesh& mesh) : mesh_(mesh) {
    for (const Eigen::Vector3f& v : mesh.vertices) box_.extend(v.cast<double>());
    normals_.resize(mesh.triangles.size());
    tbb::parallel_for(std::size_t{0}, normals_.size(), [&](std::size_t i) {
      const Triangle t(mesh_, i);
      normals_[i] = t.ab.cross(t.ac).stableNormalized();
    });
    const double cells = std::sqrt(static_cast<double>(normals_.size()) / (2 * kTrianglesACell));
    cell_ = std::max(box_.sizes().maxCoeff() / std::clamp(cells, 1.0, double{kMostCells}), 1e-30);
    // Large triangles lie in many cells: larger cells until there are few entries for each.
    while (CountEntries() > 12 * normals_.size() + 4096 || count_.cast<double>().prod() > kLargest)
      cell_ *= 2;
    Fill();
  }

  std::size_t size() const { return normals_.size(); }
  Triangle triangle(std::size_t i) const { return {mesh_, i}; }
  /// Of length 1; 0 for a triangle without area.
  const Eigen::Vector3d& normal(std::size_t triangle) const { return normals_[triangle]; }

  /// The nearest triangle other than `self`, from `start` in the direction of length 1, that faces
  /// along it; anything beyond `limit` counts as infinitely far.
  Hit Shoot(std::size_t self, const Eigen::Vector3d& start, const Eigen::Vector3d& direction,
            const std::atomic<double>& limit) const {
    Eigen::Array3i cell = CellOf(start);
    Eigen::Array3d next, step;
    Eigen::Array3i way;
    for (int k = 0; k < 3; ++k) {
      way[k] = direction[k] > 0 ? 1 : -1;
      const double border = box_.min()[k] + cell_ * (cell[k] + (way[k] > 0 ? 1 : 0));
      next[k] = direction[k] != 0 ? (border - start[k]) / direction[k] : kInfinity;
      step[k] = direction[k] != 0 ? cell_ / std::abs(direction[k]) : kInfinity;
    }
    Hit nearest;
    for (double from = 0;
         from <= std::min(nearest.distance, limit.load(std::memory_order_relaxed));) {
      const std::size_t c = Index(cell);
      for (std::size_t i = first_[c]; i < first_[c + 1]; ++i) {
        // Most of what is near is on the side that the ray comes from.
        if (!(normals_[entries_[i]].dot(direction) > -kFacing) || entries_[i] == self) continue;
        const double distance = DistanceTo({mesh_, entries_[i]}, start, direction);
        if (distance < nearest.distance) nearest = {distance, entries_[i]};
      }
      Eigen::Index axis = 0;
      from = next.minCoeff(&axis);
      next[axis] += step[axis];
      cell[axis] += way[axis];
      if (cell[axis] < 0 || cell[axis] >= count_[axis]) break;
    }
    return nearest;
  }

 private:
  Eigen::Array3i CellOf(const Eigen::Vector3d& p) const {
    return ((p - box_.min()).array() / cell_).cast<int>().max(0).min(count_ - 1);
  }
  std::size_t Index(const Eigen::Array3i& cell) const {
    return (static_cast<std::size_t>(cell.x()) * static_cast<std::size_t>(count_.y()) +
            static_cast<std::size_t>(cell.y())) *
               static_cast<std::size_t>(count_.z()) +
           static_cast<std::size_t>(cell.z());
  }

  template <typename Visit>
  void ForCells(std::size_t triangle, Visit&& visit) const {
    const auto& [low, high] = spans_[triangle];
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int z = low[2]; z <= high[2]; ++z) visit(Index({x, y, z}));
  }

  std::size_t CountEntries() {
    count_ = (box_.sizes().array() / cell_).floor().cast<int>() + 1;
    spans_.resize(normals_.size());
    const auto add = [&](const tbb::blocked_range<std::size_t>& range, std::size_t entries) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Triangle t(mesh_, i);
        const Eigen::Vector3d b = t.a + t.ab, c = t.a + t.ac;
        const Eigen::Array3i low = CellOf(t.a.cwiseMin(b).cwiseMin(c));
        const Eigen::Array3i high = CellOf(t.a.cwiseMax(b).cwiseMax(c));
        for (int k = 0; k < 3; ++k) {
          spans_[i].low[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(low[k]);
          spans_[i].high[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(high[k]);
        }
        entries += static_cast<std::size_t>((high - low + 1).cast<double>().prod());
      }
      return entries;
    };
    return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, normals_.size(), kGrain),
                                std::size_t{0}, add, std::plus<>());
  }

  /// A counting sort, so that the order depends on the mesh alone.
  void Fill() {
    first_.assign(static_cast<std::size_t>(count_.cast<double>().prod()) + 1, 0);
    for (std::size_t i = 0; i < normals_.size(); ++i)
      ForCells(i, [&](std::size_t cell) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    entries_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < normals_.size(); ++i)
      ForCells(i, [&](std::size_t cell) { entries_[next[cell]++] = i; });
    spans_ = {};
  }

  /// Moeller and Trumbore, 1997.
  static double DistanceTo(const Triangle& t, const Eigen::Vector3d& start,
                           const Eigen::Vector3d& direction) {
    const Eigen::Vector3d p = direction.cross(t.ac);
    const double scale = t.ab.dot(p);
    const Eigen::Vector3d from = start - t.a;
    const double u = from.dot(p) / scale;
    if (!(u >= 0 && u <= 1)) return kInfinity;
    const Eigen::Vector3d q = from.cross(t.ab);
    const double v = direction.dot(q) / scale;
    if (!(v >= 0 && u + v <= 1)) return kInfinity;
    const double distance = t.ac.dot(q) / scale;
    return distance > 0 ? distance : kInfinity;
  }

  Eigen::AlignedBox3d box_;
  double cell_ = 1;
  Eigen::Array3i count_ = Eigen::Array3i::Ones();
  /// The cells that a triangle's box touches.
  struct Span {
    std::array<std::int16_t, 3> low, high;
  };
  static constexpr std::size_t kGrain = 4096;

  const Mesh& mesh_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<Span> spans_;  // while the cells are filled
  std::vector<std::uint32_t> first_, entries_;
};

}  // namespace lascaux

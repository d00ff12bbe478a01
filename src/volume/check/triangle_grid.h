#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "lascaux/volume/mesh.h"

namespace lascaux {

struct Triangle {
  Eigen::Vector3d a, ab, ac, normal;  // of length 1; 0 for a triangle without area
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
  static constexpr int kMostCells = 128;  ///< along the longest side: 2 million cells in all

 public:
  explicit TriangleGrid(const Mesh& mesh) {
    for (const Eigen::Vector3f& v : mesh.vertices) box_.extend(v.cast<double>());
    triangles_.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) triangles_.push_back(MakeTriangle(mesh, t));
    cell_ = std::max(box_.sizes().maxCoeff() / kMostCells, 1e-30);
    // Large triangles lie in many cells: larger cells until there are few entries for each.
    while (CountEntries() > 12 * triangles_.size() + 4096) cell_ *= 2;
    Fill();
  }

  const std::vector<Triangle>& triangles() const { return triangles_; }

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
        if (entries_[i] == self) continue;
        const double distance = DistanceTo(triangles_[entries_[i]], start, direction);
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
  static Triangle MakeTriangle(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
    Triangle triangle;
    triangle.a = mesh.vertices[t[0]].cast<double>();
    triangle.ab = mesh.vertices[t[1]].cast<double>() - triangle.a;
    triangle.ac = mesh.vertices[t[2]].cast<double>() - triangle.a;
    triangle.normal = triangle.ab.cross(triangle.ac).stableNormalized();
    return triangle;
  }

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
  void ForCells(const Triangle& t, Visit&& visit) const {
    const Eigen::Vector3d b = t.a + t.ab, c = t.a + t.ac;
    const Eigen::Array3i low = CellOf(t.a.cwiseMin(b).cwiseMin(c));
    const Eigen::Array3i high = CellOf(t.a.cwiseMax(b).cwiseMax(c));
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) visit(Index({x, y, z}));
  }

  std::size_t CountEntries() {
    count_ = (box_.sizes().array() / cell_).floor().cast<int>() + 1;
    std::size_t entries = 0;
    for (const Triangle& t : triangles_) {
      const Eigen::Vector3d b = t.a + t.ab, c = t.a + t.ac;
      const Eigen::Array3i size =
          CellOf(t.a.cwiseMax(b).cwiseMax(c)) - CellOf(t.a.cwiseMin(b).cwiseMin(c)) + 1;
      entries += static_cast<std::size_t>(size.cast<double>().prod());
    }
    return entries;
  }

  /// A counting sort, so that the order depends on the mesh alone.
  void Fill() {
    first_.assign(static_cast<std::size_t>(count_.cast<double>().prod()) + 1, 0);
    for (const Triangle& t : triangles_) ForCells(t, [&](std::size_t cell) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    entries_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
      ForCells(triangles_[i], [&](std::size_t cell) { entries_[next[cell]++] = i; });
  }

  /// Moeller and Trumbore, 1997.
  static double DistanceTo(const Triangle& t, const Eigen::Vector3d& start,
                           const Eigen::Vector3d& direction) {
    if (!(t.normal.dot(direction) > -kFacing)) return kInfinity;
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
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> first_, entries_;
};

}  // namespace lascaux

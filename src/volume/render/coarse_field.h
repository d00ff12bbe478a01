#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "volume/render/leaf_table.h"

/// @file
/// A dense, coarse picture of a narrow band: how far is it to the surface from anywhere?

namespace lascaux {

/// Approximate distances in voxels at every stride-th voxel of a box around the surface, positive
/// outside.
///
/// Exact at nodes in the band. Beyond it within one stride: enough to skip empty space with a
/// margin of 1.5 strides, and for light that comes from large areas. Inside the band's inner edge
/// it stays at minus the band's width.
class CoarseField {
 public:
  /// Distances are wrong by less than this many strides.
  static constexpr float kError = 0.8F;

  /// About `nodes` nodes along the longest side. The level set has active voxels.
  CoarseField(const LeafTable& table, int nodes);

  /// At a place in index space, trilinear; outside the box a lower bound by Pythagoras.
  float At(const Eigen::Vector3f& p) const noexcept {
    const float x = (p.x() - origin_.x()) * inverse_stride_;
    const float y = (p.y() - origin_.y()) * inverse_stride_;
    const float z = (p.z() - origin_.z()) * inverse_stride_;
    const float cx = std::clamp(x, 0.F, limit_.x());
    const float cy = std::clamp(y, 0.F, limit_.y());
    const float cz = std::clamp(z, 0.F, limit_.z());
    const float value = Trilinear(cx, cy, cz);
    const float dx = x - cx, dy = y - cy, dz = z - cz;
    const float beyond = dx * dx + dy * dy + dz * dz;
    if (beyond == 0) return value;
    return std::sqrt(value * value + beyond * stride_ * stride_);
  }

  float stride() const noexcept { return stride_; }  ///< voxels between nodes
  /// Box of the nodes, in index space.
  Eigen::Vector3f low() const noexcept { return origin_; }
  Eigen::Vector3f high() const noexcept { return origin_ + stride_ * limit_; }
  /// Height of the lowest point of the surface, within half a voxel.
  float ground() const noexcept { return ground_; }
  /// Nodes within a stride of the surface or inside: what a camera has to see.
  std::vector<Eigen::Vector3f> SolidNodes() const;

 private:
  friend struct CoarseLanes;

  void Sample(const LeafTable& table, const Eigen::Vector3i& origin, float band);

  std::size_t Index(int x, int y, int z) const noexcept {
    return static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x);
  }

  float Trilinear(float px, float py, float pz) const noexcept {
    // limit_ is a hair below the last node, so that truncation finds a cell.
    const auto x = static_cast<int>(px), y = static_cast<int>(py), z = static_cast<int>(pz);
    const float fx = px - static_cast<float>(x);
    const float fy = py - static_cast<float>(y);
    const float fz = pz - static_cast<float>(z);
    const float* const v = distance_.data() + Index(x, y, z);
    const float* const w = v + slice_;
    const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
    const float near = mix(mix(v[0], v[1], fx), mix(v[row_], v[row_ + 1], fx), fy);
    const float far = mix(mix(w[0], w[1], fx), mix(w[row_], w[row_ + 1], fx), fy);
    return mix(near, far, fz);
  }

  std::ptrdiff_t row_ = 0, slice_ = 0;
  Eigen::Vector3f origin_, limit_;
  float stride_ = 1, inverse_stride_ = 1, ground_ = 0;
  std::array<int, 3> size_ = {};
  std::vector<float> distance_;
};

}  // namespace lascaux

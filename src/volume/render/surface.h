#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "volume/render/coarse_field.h"

/// @file
/// Rays against a level set.

namespace lascaux {

/// A half line in index space; `direction` has length 1.
struct Ray {
  Eigen::Vector3f origin, direction;

  Eigen::Vector3f At(float t) const noexcept { return origin + t * direction; }
};

/// Half lines from one place.
struct Rays {
  Eigen::Vector3f origin{0, 0, 0};
  std::vector<float> x, y, z;  ///< directions, of length 1
  std::vector<float> from;     ///< the part of each before this is known to be free

  std::size_t size() const noexcept { return from.size(); }

  /// Takes the origin for that of all.
  void Add(const Ray& ray, float free) {
    origin = ray.origin;
    x.push_back(ray.direction.x()), y.push_back(ray.direction.y()), z.push_back(ray.direction.z());
    from.push_back(free);
  }

  Eigen::Vector3f At(std::size_t i, float t) const noexcept {
    return origin + t * Eigen::Vector3f(x[i], y[i], z[i]);
  }
};

/// A level set, ready to be met by rays: a table of its leaves, since an accessor is slow where
/// cells reach over leaves.
///
/// 8 bytes for each 8 x 8 x 8 voxels of its box. May be shared between threads.
class Surface {
 public:
  /// What the table's leaves belong to must outlive it, and so must the coarse field.
  Surface(const LeafTable& table, const CoarseField& coarse);

  /// First places along the rays that are inside, as distances from their origin, within 0.05
  /// voxels; infinite where there is none.
  ///
  /// Eight rays are followed at once, and a new one is taken when one of them is over: best for
  /// many that are side by side.
  std::vector<float> Hit(const Rays& rays) const;

  /// How far all rays are free that differ from this one's direction by less than a tangent of
  /// `spread`; infinite if none of them can meet the surface. `from` is known already.
  float FreeLength(const Ray& ray, float spread, float from) const noexcept;

  /// Unit normal near the surface: gradient of the quadratic B-spline over 27 voxels, continuous,
  /// with the grid's noise smoothed away.
  Eigen::Vector3f Normal(const Eigen::Vector3f& p) const noexcept;

 private:
  static constexpr int kLeafLog = 3, kLeafSize = 1 << kLeafLog;
  static constexpr int kStrideX = kLeafSize * kLeafSize, kStrideY = kLeafSize;

  friend class RayMarch;

  const float* LeafOf(const std::array<int, 3>& c) const noexcept {
    const int x = c[0] >> kLeafLog, y = c[1] >> kLeafLog, z = c[2] >> kLeafLog;
    return leaves_[static_cast<std::size_t>((x * size_[1] + y) * size_[2] + z)];
  }
  static int InLeaf(const std::array<int, 3>& c) noexcept {
    constexpr int kMask = kLeafSize - 1;
    return (c[0] & kMask) * kStrideX + (c[1] & kMask) * kStrideY + (c[2] & kMask);
  }
  float Value(const std::array<int, 3>& c) const noexcept { return LeafOf(c)[InLeaf(c)]; }

  const CoarseField* coarse_;
  float per_voxel_, band_;
  Eigen::Vector3f low_, high_;    ///< where rays look
  Eigen::Vector3f origin_;        ///< of the table, in index space
  std::array<int, 3> size_ = {};  ///< in leaves
  std::vector<const float*> leaves_;
  std::shared_ptr<const std::array<LeafTable::Leaf, 2>> constant_;  ///< some leaves are in there
};

}  // namespace lascaux

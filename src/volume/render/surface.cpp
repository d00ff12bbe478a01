#include "volume/render/surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lascaux {
namespace {

/// Steps of less than this many strides are left to the single rays.
constexpr float kLeastShare = 0.5F;
constexpr int kMaxSteps = 2000;  // far more than any ray needs: ends a march through a broken grid

}  // namespace

Surface::Surface(const LeafTable& table, const CoarseField& coarse)
    : coarse_(&coarse),
      per_voxel_(1 / table.voxel_size),
      band_(table.background / table.voxel_size),
      low_(coarse.low()),
      high_(coarse.high()),
      constant_(table.constant) {
  static_assert(kBlockSide == kLeafSize);
  // A leaf to spare on every side: cells and stencils reach beyond the rays' box.
  const auto leaf_of = [](float x) { return static_cast<int>(std::floor(x / kLeafSize)); };
  Eigen::Vector3i first;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = leaf_of(low_[axis]) - 1;
    size_[static_cast<std::size_t>(axis)] = leaf_of(high_[axis]) + 2 - first[axis];
  }
  origin_ = (kLeafSize * first).cast<float>();
  leaves_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                 static_cast<std::size_t>(size_[2]));
  tbb::parallel_for(tbb::blocked_range<int>(0, size_[0]), [&](const auto& slices) {
    for (int x = slices.begin(); x < slices.end(); ++x) {
      auto slot = leaves_.begin() + static_cast<std::ptrdiff_t>(x) * size_[1] * size_[2];
      for (int y = 0; y < size_[1]; ++y)
        for (int z = 0; z < size_[2]; ++z) *slot++ = table.At(first + Eigen::Vector3i(x, y, z));
    }
  });
}

float Surface::FreeLength(const Ray& ray, float spread, float from) const noexcept {
  const Eigen::Vector3f middle = 0.5F * (low_ + high_);
  const float last = (middle - ray.origin).norm() + (high_ - middle).norm();
  float t = from;
  for (int step = 0; step < kMaxSteps && t < last; ++step) {
    const float free =
        coarse_->At(ray.At(t)) - CoarseField::kError * coarse_->stride() - spread * t;
    if (free < kLeastShare * coarse_->stride()) return t;
    t += free;
  }
  return std::numeric_limits<float>::infinity();
}

Eigen::Vector3f Surface::Normal(const Eigen::Vector3f& p) const noexcept {
  // Weights of the quadratic B-spline and of its derivative at the three nearest voxels of each
  // axis.
  std::array<std::array<float, 3>, 3> weight, slope;
  std::array<int, 3> base;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float x = p[static_cast<int>(axis)] - origin_[static_cast<int>(axis)];
    const int nearest = static_cast<int>(x + 0.5F);
    const float f = x - static_cast<float>(nearest);
    base[axis] = nearest - 1;
    weight[axis] = {0.5F * (0.5F - f) * (0.5F - f), 0.75F - f * f, 0.5F * (0.5F + f) * (0.5F + f)};
    slope[axis] = {f - 0.5F, -2 * f, f + 0.5F};
  }
  Eigen::Vector3f gradient(0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      float value = 0, along_z = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const float v = Value({base[0] + static_cast<int>(i), base[1] + static_cast<int>(j),
                               base[2] + static_cast<int>(k)});
        value += weight[2][k] * v;
        along_z += slope[2][k] * v;
      }
      gradient +=
          Eigen::Vector3f(slope[0][i] * weight[1][j] * value, weight[0][i] * slope[1][j] * value,
                          weight[0][i] * weight[1][j] * along_z);
    }
  }
  return gradient.stableNormalized();
}

}  // namespace lascaux

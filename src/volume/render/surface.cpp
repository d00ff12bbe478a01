#include "volume/render/surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lascaux {
namespace {

/// Distances from the coarse field are wrong by less than this many of its strides.
constexpr float kCoarseError = 0.8F;
/// Above this many strides a step with the coarse field is longer than one with the band.
constexpr float kCoarseRange = 1.4F;
/// Share of a distance that is stepped: fields are not quite distances where parts blend.
constexpr float kStepShare = 0.9F;
// In voxels. The least step bounds the work for rays that graze the surface; guessed steps stay
// below the thinnest features that a grid can hold.
constexpr float kLeastStep = 0.15F;
constexpr float kLongestGuess = 1.2F;
constexpr float kOvershoot = 0.06F;
constexpr float kClose = 0.02F;
constexpr int kRefinements = 2;
/// Share of the band within which the next step looks at the band first.
constexpr float kBandEdge = 0.95F;
/// Steps of less than this many strides are left to the single rays.
constexpr float kLeastShare = 0.5F;
constexpr int kMaxSteps = 2000;  // far more than any ray needs: ends a march through a broken grid

/// Part of the ray within the box, or an empty range.
std::array<float, 2> Clip(const Ray& ray, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  std::array<float, 2> range = {0, 1e9F};
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse =
        1 / ray.direction[axis];  // infinite for parallel rays, which sorts itself out
    const float a = (low[axis] - ray.origin[axis]) * inverse;
    const float b = (high[axis] - ray.origin[axis]) * inverse;
    range[0] = std::max(range[0], std::min(a, b));
    range[1] = std::min(range[1], std::max(a, b));
  }
  return range;
}

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

float Surface::At(const Eigen::Vector3f& p) const noexcept {
  const Eigen::Vector3f local = p - origin_;  // positive: truncation is floor
  const std::array<int, 3> c = {static_cast<int>(local.x()), static_cast<int>(local.y()),
                                static_cast<int>(local.z())};
  const float fx = local.x() - static_cast<float>(c[0]);
  const float fy = local.y() - static_cast<float>(c[1]);
  const float fz = local.z() - static_cast<float>(c[2]);
  constexpr int kLast = kLeafSize - 1;
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const auto mix_all = [&](const std::array<float, 8>& v) {
    const float low = mix(mix(v[0], v[1], fz), mix(v[2], v[3], fz), fy);
    const float high = mix(mix(v[4], v[5], fz), mix(v[6], v[7], fz), fy);
    return per_voxel_ * mix(low, high, fx);
  };
  if ((c[0] & kLast) < kLast && (c[1] & kLast) < kLast && (c[2] & kLast) < kLast) {
    const float* const q = LeafOf(c) + InLeaf(c);
    return mix_all({q[0], q[1], q[kStrideY], q[kStrideY + 1], q[kStrideX], q[kStrideX + 1],
                    q[kStrideX + kStrideY], q[kStrideX + kStrideY + 1]});
  }
  const auto at = [&](int x, int y, int z) { return Value({c[0] + x, c[1] + y, c[2] + z}); };
  return mix_all({at(0, 0, 0), at(0, 0, 1), at(0, 1, 0), at(0, 1, 1), at(1, 0, 0), at(1, 0, 1),
                  at(1, 1, 0), at(1, 1, 1)});
}

float Surface::Refine(const Ray& ray, Probe outside, Probe inside) const noexcept {
  const auto crossing = [&] {
    return outside.t +
           (inside.t - outside.t) * outside.distance / (outside.distance - inside.distance);
  };
  for (int i = 0; i < kRefinements; ++i) {
    const float t = crossing();
    const Probe probe{t, At(ray.At(t))};
    if (std::abs(probe.distance) < kClose) return t;
    (probe.distance > 0 ? outside : inside) = probe;
  }
  return crossing();
}

std::optional<float> Surface::Hit(const Ray& ray, float from) const noexcept {
  const auto [begin, end] = Clip(ray, low_, high_);
  Probe last{std::max(begin, from), band_};
  float t = last.t;
  bool in_band = false;
  for (int step = 0; step < kMaxSteps && t < end; ++step) {
    const Eigen::Vector3f p = ray.At(t);
    if (!in_band) {
      const float rough = coarse_->At(p);
      in_band = rough <= kCoarseRange * coarse_->stride();
      if (!in_band) {
        t += rough - kCoarseError * coarse_->stride();
        continue;
      }
      last = {t, band_};
    }
    const Probe probe{t, At(p)};
    if (probe.distance <= 0) return probe.t > last.t ? Refine(ray, last, probe) : probe.t;
    in_band = probe.distance < kBandEdge * band_;
    float length = std::max(kStepShare * probe.distance, kLeastStep);
    // Where the distance shrinks steadily the surface is a little beyond the place where it would
    // be 0.
    const float slope = (last.distance - probe.distance) / (probe.t - last.t);
    if (last.distance < band_ && slope > 0) {
      length = std::max(length, std::min(probe.distance / slope, kLongestGuess) + kOvershoot);
    }
    last = probe;
    t += length;
  }
  return std::nullopt;
}

float Surface::FreeLength(const Ray& ray, float spread, float from) const noexcept {
  const Eigen::Vector3f middle = 0.5F * (low_ + high_);
  const float last = (middle - ray.origin).norm() + (high_ - middle).norm();
  float t = from;
  for (int step = 0; step < kMaxSteps && t < last; ++step) {
    const float free = coarse_->At(ray.At(t)) - kCoarseError * coarse_->stride() - spread * t;
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

#include "volume/render/ground_shadow.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lascaux {
namespace {

constexpr int kTexels = 176;        // along the longer side
constexpr float kSurround = 0.54F;  // of the model's size, around it: shadows have faded there

float Smooth(float t) {
  t = std::clamp(t, 0.F, 1.F);
  return t * t * (3 - 2 * t);
}

}  // namespace

GroundShadow::GroundShadow(const Studio& studio, const CoarseField& coarse)
    : ground_(studio.ground()) {
  const float surround = kSurround * studio.size();
  const Eigen::Vector3f low = coarse.low(), high = coarse.high();
  low_ = Eigen::Vector2f(low.x(), low.z()).array() - surround;
  const Eigen::Vector2f extent =
      Eigen::Vector2f(high.x(), high.z()).array() + surround - low_.array();
  texel_ = extent.maxCoeff() / (kTexels - 1);
  width_ = static_cast<int>(extent.x() / texel_) + 2;
  depth_ = static_cast<int>(extent.y() / texel_) + 2;
  shadow_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(depth_));
  tbb::parallel_for(tbb::blocked_range<int>(0, depth_), [&](const auto& rows) {
    std::vector<Eigen::Vector2f> places(static_cast<std::size_t>(width_));
    for (int z = rows.begin(); z < rows.end(); ++z) {
      for (int x = 0; x < width_; ++x) {
        places[static_cast<std::size_t>(x)] =
            low_ + texel_ * Eigen::Vector2f(static_cast<float>(x), static_cast<float>(z));
      }
      const std::vector<float> shadow = studio.FloorShadow(places);
      for (int x = 0; x < width_; ++x) {
        // Fades before the raster ends, however the model stands.
        const int inset = std::min({x, z, width_ - 1 - x, depth_ - 1 - z});
        const float edge = static_cast<float>(inset) * texel_ / surround;
        shadow_[static_cast<std::size_t>(z * width_ + x)] =
            Smooth(1.4F * edge) * shadow[static_cast<std::size_t>(x)];
      }
    }
  });
}

float GroundShadow::At(const Ray& ray) const noexcept {
  if (!(ray.direction.y() < 0)) return 0;
  const Eigen::Vector3f p = ray.At((ground_ - ray.origin.y()) / ray.direction.y());
  const float u = (p.x() - low_.x()) / texel_, v = (p.z() - low_.y()) / texel_;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(width_ - 1) &&
        v < static_cast<float>(depth_ - 1))) {
    return 0;
  }
  const int x = static_cast<int>(u), z = static_cast<int>(v);
  const float fx = u - static_cast<float>(x), fz = v - static_cast<float>(z);
  const float near = Texel(x, z) + fx * (Texel(x + 1, z) - Texel(x, z));
  const float far = Texel(x, z + 1) + fx * (Texel(x + 1, z + 1) - Texel(x, z + 1));
  return near + fz * (far - near);
}

}  // namespace lascaux

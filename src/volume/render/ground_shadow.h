#pragma once

#include <Eigen/Core>
#include <vector>

#include "volume/render/light.h"

namespace lascaux {

/// The model's shadow on the floor, computed once on a raster in the floor's plane: it is smooth,
/// and the picture's pixels are many.
class GroundShadow {
 public:
  GroundShadow(const Studio& studio, const CoarseField& coarse);

  /// Share of light, 0 to 1, that a ray's place on the floor is short of; 0 where it misses the
  /// floor.
  float At(const Ray& ray) const noexcept;

 private:
  float Texel(int x, int z) const noexcept {
    return shadow_[static_cast<std::size_t>(z * width_ + x)];
  }

  float ground_, texel_;
  Eigen::Vector2f low_;
  int width_, depth_;
  std::vector<float> shadow_;
};

}  // namespace lascaux

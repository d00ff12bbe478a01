#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/volume/render.h"
#include "volume/render/surface.h"

namespace lascaux {

/// A perspective camera with a long lens, in index space (y up).
///
/// `side` and `front` are horizontal: to the right of the picture, and from the model towards the
/// camera; with y they make the frame in which the lights stand.
class Camera {
 public:
  /// Sees all points of `solid` (not empty), centred, with a margin.
  Camera(const RenderOptions& options, const std::vector<Eigen::Vector3f>& solid);

  /// Through a place of the picture in pixels, from the upper left corner.
  Ray Through(float x, float y) const noexcept {
    const Eigen::Vector3f d =
        forward_ + (x - half_width_) * pixel_ * right_ - (y - half_height_) * pixel_ * up_;
    return {eye_, d.normalized()};
  }

  const Eigen::Vector3f& side() const noexcept { return side_; }
  const Eigen::Vector3f& front() const noexcept { return front_; }
  const Eigen::Vector3f& right() const noexcept { return right_; }
  const Eigen::Vector3f& up() const noexcept { return up_; }
  const Eigen::Vector3f& forward() const noexcept { return forward_; }

  /// Distance of a place along the camera's axis.
  float Depth(const Eigen::Vector3f& p) const noexcept { return forward_.dot(p - eye_); }

  float pixel() const noexcept { return pixel_; }  ///< width of a pixel at distance 1

 private:
  void Aim(View view, const std::vector<Eigen::Vector3f>& solid);

  Eigen::Vector3f side_, front_, right_, up_, forward_, eye_;
  float half_width_, half_height_;
  float pixel_ = 0;
};

}  // namespace lascaux

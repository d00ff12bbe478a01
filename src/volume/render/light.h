#pragma once

#include <Eigen/Core>
#include <array>

#include "volume/render/camera.h"
#include "volume/render/coarse_field.h"

/// @file
/// A small photo studio around the model: a large soft key light, a bright sky, a floor that throws
/// light back.
///
/// Areas of light are marched as cones through the coarse distances, which needs no random rays and
/// leaves no noise. Source: A. Evans, "Fast Approximations for Global Illumination on Dynamic
/// Scenes", SIGGRAPH 2006 course notes, for occlusion from distance fields.

namespace lascaux {

using Color = Eigen::Array3f;  // linear light, sRGB primaries
using Light = Eigen::Array4f;  // a color and the share that it covers, associated

/// What a place on the surface sees of the lights: shares of the key light and of the light from
/// behind, and all that comes from the sky and the floor.
struct Lighting {
  float key = 0, rim = 0;
  Color ambient = Color::Zero();

  Lighting& operator+=(const Lighting& other) noexcept {
    key += other.key;
    rim += other.rim;
    ambient += other.ambient;
    return *this;
  }
  Lighting operator*(float n) const noexcept { return {key * n, rim * n, ambient * n}; }
};

/// A place on the surface as the camera sees it.
struct Facet {
  Eigen::Vector3f normal, to_eye;
  Color albedo;  ///< share of light that it throws back
};

/// The lights' places, fixed to the camera so that every view is lit alike, and what they see of
/// the model.
class Studio {
 public:
  /// Both must outlive it.
  Studio(const CoarseField& coarse, const Camera& camera);

  /// What reaches a place on the surface. It varies slowly, and costs most.
  Lighting Gather(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const noexcept;

  /// Light that a place sends towards the camera.
  Color Shade(const Lighting& lighting, const Facet& facet) const noexcept;

  /// Share of the key light, 0 to 1, that reaches a place; `lift` voxels are left out at its
  /// beginning.
  float KeyVisibility(const Eigen::Vector3f& p, float lift) const noexcept;

  /// Share of a cone of half angle about 30 degrees that is free, weighted towards near obstacles.
  float ConeVisibility(const Eigen::Vector3f& p, const Eigen::Vector3f& direction) const noexcept;

  /// How close the model is above a place on the floor, 0 to 1: round and without directions.
  float Contact(const Eigen::Vector3f& p) const noexcept;

  /// Size of the model in voxels, which all lengths of light are relative to.
  float size() const noexcept { return size_; }
  float ground() const noexcept { return coarse_->ground(); }

 private:
  Color Ambient(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const noexcept;

  const CoarseField* coarse_;
  const Camera* camera_;
  float size_;
  Eigen::Vector3f key_, rim_;
  std::array<float, 4> reach_;  ///< lengths at which a cone looks, in voxels
};

}  // namespace lascaux

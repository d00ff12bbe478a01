#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

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

/// A place on the surface.
struct Sample {
  Eigen::Vector3f place, normal;
};

/// A place on the surface as the camera sees it.
struct Facet {
  Eigen::Vector3f normal, to_eye;
  Color albedo;  ///< share of light that it throws back
};

/// How far light creeps around the terminator, by colour: red goes deepest in clay as in skin.
inline const Color kWrap(0.30F, 0.22F, 0.17F);
inline constexpr float kRimWrap = 0.15F;

/// The lights' places, fixed to the camera so that every view is lit alike, and what they see of
/// the model.
class Studio {
 public:
  /// Both must outlive it.
  Studio(const CoarseField& coarse, const Camera& camera);

  /// What reaches places on the surface. It varies slowly, and costs most. Eight are looked at
  /// at once.
  std::vector<Lighting> Gather(std::span<const Sample> samples) const;

  /// Light that a place sends towards the camera.
  Color Shade(const Lighting& lighting, const Facet& facet) const noexcept;

  /// Share of the floor's light, 0 to 1, that the model keeps away from places (x, z) on it.
  std::vector<float> FloorShadow(std::span<const Eigen::Vector2f> places) const;

  /// Size of the model in voxels, which all lengths of light are relative to.
  float size() const noexcept { return size_; }
  float ground() const noexcept { return coarse_->ground(); }

 private:
  friend class LightLanes;

  const CoarseField* coarse_;
  const Camera* camera_;
  float size_;
  Eigen::Vector3f key_, rim_;
  std::array<float, 4> reach_;  ///< lengths at which a cone looks, in voxels
};

}  // namespace lascaux

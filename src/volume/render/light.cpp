#include "volume/render/light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

// Colours and strengths were chosen by eye on many models; linear light, 1 is white paper.
const Color kKeyLight(1.78F, 1.62F, 1.40F);
const Color kRimLight(0.55F, 0.60F, 0.68F);

constexpr float kRim = 1.2F;
constexpr float kGloss = 0.13F;      // strength of the sheen
constexpr float kGlossPower = 14.F;  // its breadth: fired clay is dull

}  // namespace

Studio::Studio(const CoarseField& coarse, const Camera& camera)
    : coarse_(&coarse), camera_(&camera) {
  const Eigen::Vector3f extent = coarse.high() - coarse.low();
  size_ = extent.maxCoeff();
  const Eigen::Vector3f y(0, 1, 0);
  key_ = (-0.62F * camera.side() + 1.35F * y + 0.62F * camera.front()).normalized();
  rim_ = (0.75F * camera.side() + 0.45F * y - 0.65F * camera.front()).normalized();
  const float shortest = 2.5F * coarse.stride();
  for (std::size_t i = 0; i < reach_.size(); ++i) {
    reach_[i] = shortest + size_ * 0.016F * (std::pow(2.2F, static_cast<float>(i)) - 1);
  }
}

Color Studio::Shade(const Lighting& lighting, const Facet& facet) const noexcept {
  const auto& [normal, to_eye, albedo] = facet;
  const Color wrapped = ((normal.dot(key_) + kWrap) / (1 + kWrap)).max(0.F);
  Color light = lighting.ambient + lighting.key * kKeyLight * wrapped * wrapped.sqrt();
  const float grazing = 1 - std::max(0.F, normal.dot(to_eye));
  const float behind = std::max(0.F, normal.dot(rim_) + kRimWrap);
  light += kRim * lighting.rim * behind * grazing * grazing * kRimLight;
  const Eigen::Vector3f half = (key_ + to_eye).normalized();
  const float gloss = kGloss * std::pow(std::max(0.F, normal.dot(half)), kGlossPower);
  return albedo * light + lighting.key * gloss * kKeyLight;
}

}  // namespace lascaux

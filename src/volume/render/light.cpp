#include "volume/render/light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

// Colours and strengths were chosen by eye on many models; linear light, 1 is white paper.
const Color kKeyLight(1.78F, 1.62F, 1.40F);
const Color kSky(0.50F, 0.57F, 0.68F);
const Color kHorizon(0.38F, 0.39F, 0.41F);
const Color kFloor(0.40F, 0.335F, 0.28F);
const Color kRimLight(0.55F, 0.60F, 0.68F);

/// How far light creeps around the terminator, by colour: red goes deepest in clay as in skin.
const Color kWrap(0.30F, 0.22F, 0.17F);

constexpr float kConeTangent = 0.6F;
constexpr float kKeySize = 0.32F;  // tangent of the key light's half angle
constexpr float kKeyReach = 1.0F;  // of the model's size, after which nothing throws a shadow
constexpr int kKeySteps = 40;
constexpr float kRim = 1.2F;
constexpr float kRimWrap = 0.15F;
constexpr float kLift = 1.2F, kKeyLift = 2.F;  // strides of the coarse field
constexpr float kGloss = 0.13F;                // strength of the sheen
constexpr float kGlossPower = 14.F;            // its breadth: fired clay is dull

float Smooth(float t) {
  t = std::clamp(t, 0.F, 1.F);
  return t * t * (3 - 2 * t);
}

/// The sphere's six cones around +z: one along it and five that lean out by 60 degrees, weights by
/// cosine.
struct Cone {
  Eigen::Vector3f direction;
  float weight;
};

std::array<Cone, 6> MakeCones() {
  std::array<Cone, 6> cones;
  cones[0] = {{0, 0, 1}, 0.25F};
  for (std::size_t i = 1; i < 6; ++i) {
    const float angle = 1.2566371F * static_cast<float>(i);
    cones[i] = {{0.866F * std::cos(angle), 0.866F * std::sin(angle), 0.5F}, 0.15F};
  }
  return cones;
}

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

float Studio::KeyVisibility(const Eigen::Vector3f& p, float lift) const noexcept {
  float light = 1, t = lift;
  // Above the model nothing is in the way.
  const float end = std::min(kKeyReach * size_, (coarse_->high().y() - p.y()) / key_.y());
  for (int step = 0; step < kKeySteps && t < end && light > 0.01F; ++step) {
    const float distance = coarse_->At(p + t * key_);
    // Half of the lamp is hidden where the ray just touches the model.
    light = std::min(light, 0.5F + 0.5F * distance / (kKeySize * t));
    t += std::max(0.75F * distance, 0.018F * size_);
  }
  return Smooth(light);
}

float Studio::ConeVisibility(const Eigen::Vector3f& p,
                             const Eigen::Vector3f& direction) const noexcept {
  float free = 1;
  for (const float t : reach_) {
    const Eigen::Vector3f q = p + t * direction;
    const float distance = coarse_->At(q);
    free = std::min(free, std::max(0.F, distance) / (kConeTangent * t) + 0.0F);
  }
  return Smooth(free);
}

float Studio::Contact(const Eigen::Vector3f& p) const noexcept {
  constexpr int kHeights = 6;
  constexpr float kFirst = 0.012F, kGrowth = 1.7F;  // of the model's size
  float contact = 0, weight = 0, total = 0, height = kFirst * size_;
  for (int i = 0; i < kHeights; ++i, height *= kGrowth) {
    weight = 1 / (1 + 0.25F * static_cast<float>(i));
    const float distance = std::max(0.F, coarse_->At(p + Eigen::Vector3f(0, height, 0)));
    contact += weight * Smooth(1 - distance / (1.25F * height));
    total += weight;
  }
  return contact / total;
}

Color Studio::Ambient(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const noexcept {
  static const std::array<Cone, 6> kCones = MakeCones();
  // The smallest rotation that takes the direction to the camera to the normal: continuous over all
  // that can be seen.
  const Eigen::Vector3f n(normal.dot(camera_->right()), normal.dot(camera_->up()),
                          -normal.dot(camera_->forward()));
  const float a = 1 / (1 + std::max(n.z(), -0.99F));
  const float b = -n.x() * n.y() * a;
  const Eigen::Vector3f u(1 - n.x() * n.x() * a, b, -n.x());
  const Eigen::Vector3f v(b, 1 - n.y() * n.y() * a, -n.y());
  Color light(0, 0, 0);
  for (const Cone& cone : kCones) {
    const Eigen::Vector3f local =
        cone.direction.x() * u + cone.direction.y() * v + cone.direction.z() * n;
    const Eigen::Vector3f direction =
        local.x() * camera_->right() + local.y() * camera_->up() - local.z() * camera_->forward();
    const float free = ConeVisibility(p, direction);
    const float height = direction.y();
    Color from = height > 0 ? kHorizon + height * (kSky - kHorizon) : kHorizon;
    if (height < 0) {
      // The floor is darker under the model, where its light is kept away.
      const float above = std::max(0.F, p.y() - ground()) / size_;
      const float lit = 0.45F + 0.55F * Smooth(above / 0.35F);
      from += Smooth(-2.5F * height) * (lit * kFloor - kHorizon);
    }
    light += cone.weight * (0.06F + 0.94F * free) * from;
  }
  return light;
}

Lighting Studio::Gather(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const noexcept {
  // The coarse field is rough near the surface: light is looked for from a little above it.
  const Eigen::Vector3f start = p + kLift * coarse_->stride() * normal;
  Lighting lighting;
  if (normal.dot(key_) > -kWrap.maxCoeff()) {
    lighting.key = KeyVisibility(start, kKeyLift * coarse_->stride());
  }
  if (normal.dot(rim_) > -kRimWrap) lighting.rim = ConeVisibility(start, rim_);
  lighting.ambient = Ambient(p, normal);
  return lighting;
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

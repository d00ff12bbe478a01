#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "lascaux/field/compiled_field.h"
#include "volume/render/coarse_lanes.h"
#include "volume/render/light.h"

/// @file
/// Studio::Gather and Studio::FloorShadow: what reaches eight places at a time.

namespace lascaux {
namespace {

// Colours and strengths were chosen by eye on many models; linear light, 1 is white paper.
constexpr std::array<float, 3> kSky = {0.50F, 0.57F, 0.68F};
constexpr std::array<float, 3> kHorizon = {0.38F, 0.39F, 0.41F};
constexpr std::array<float, 3> kFloor = {0.40F, 0.335F, 0.28F};
constexpr float kDarkestFloor = 0.45F;  // under the model, as a share of kFloor
constexpr float kFloorReach = 0.35F;    // of the model's size, above which the floor is all bright
constexpr float kLeastFree = 0.06F;     // of a cone that nothing comes through

constexpr float kConeTangent = 0.6F;
constexpr float kKeySize = 0.32F;  // tangent of the key light's half angle
constexpr float kKeyReach = 1.0F;  // of the model's size, after which nothing throws a shadow
constexpr int kKeySteps = 40;
constexpr float kKeyStep = 0.75F, kLeastKeyStep = 0.018F;  // of the distance; of the model's size
constexpr float kDark = 0.01F;                             // no less light is looked for
constexpr float kLift = 1.2F, kKeyLift = 2.F;              // strides of the coarse field

constexpr float kFloorLift = 0.01F;  // of the model's size
constexpr float kKeyShare = 0.44F;   // of the floor's light that comes from the key light
constexpr float kSkyShare = 0.62F;   // of what is left, as far as the model can hide it

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

LASCAUX_INLINE Lanes Smooth(Lanes t) {
  t = Min(Max(t, Lanes{}), All(1));
  return t * t * (3 - 2 * t);
}

LASCAUX_INLINE Lanes Dot(const LanePoint& a, const Eigen::Vector3f& b) {
  return a.x * b.x() + a.y * b.y() + a.z * b.z();
}

/// a + t b, and the like.
LASCAUX_INLINE LanePoint Along(const LanePoint& a, const Lanes& t, const LanePoint& b) {
  return {a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}
LASCAUX_INLINE LanePoint Along(const LanePoint& a, const Lanes& t, const Eigen::Vector3f& b) {
  return {a.x + t * b.x(), a.y + t * b.y(), a.z + t * b.z()};
}

}  // namespace

/// The lights as eight places see them.
class LightLanes {
 public:
  explicit LightLanes(const Studio& studio) : studio_(studio), coarse_{*studio.coarse_} {}

  LASCAUX_INLINE void Gather(std::span<const Sample> samples, std::span<Lighting> lighting) const {
    for (std::size_t first = 0; first < samples.size(); first += kLanes)
      GatherEight(samples.subspan(first), lighting.subspan(first));
  }

  LASCAUX_INLINE void FloorShadow(std::span<const Eigen::Vector2f> places,
                                  std::span<float> shadow) const {
    for (std::size_t first = 0; first < places.size(); first += kLanes) {
      const std::size_t last = std::min(kLanes, places.size() - first) - 1;
      const auto along = [&](int axis) LASCAUX_INLINED {
        return Each([&](std::size_t k)
                        LASCAUX_INLINED { return places[first + std::min(k, last)][axis]; });
      };
      const LanePoint p{along(0), All(studio_.ground()), along(1)};
      const Lanes key = KeyVisibility(LanesIn(0xFF), p, kFloorLift * studio_.size_);
      const Lanes dark = 1 - (1 - kKeyShare * (1 - key)) * (1 - kSkyShare * Contact(p));
      for (std::size_t k = 0; k <= last; ++k) shadow[first + k] = dark[k];
    }
  }

 private:
  using Colors = std::array<Lanes, 3>;

  LASCAUX_INLINE void GatherEight(std::span<const Sample> samples,
                                  std::span<Lighting> lighting) const {
    const std::size_t last = std::min(kLanes, samples.size()) - 1;
    const auto along = [&](Eigen::Vector3f Sample::*of, int axis) LASCAUX_INLINED {
      return Each([&](std::size_t k)
                      LASCAUX_INLINED { return (samples[std::min(k, last)].*of)[axis]; });
    };
    const LanePoint p{along(&Sample::place, 0), along(&Sample::place, 1), along(&Sample::place, 2)};
    const LanePoint normal{along(&Sample::normal, 0), along(&Sample::normal, 1),
                           along(&Sample::normal, 2)};
    // The coarse field is rough near the surface: light is looked for from a little above it.
    const float stride = coarse_.coarse.stride();
    const LanePoint start = Along(p, All(kLift * stride), normal);
    const LaneMask facing = Dot(normal, studio_.key_) > -kWrap.maxCoeff();
    const LaneMask behind = Dot(normal, studio_.rim_) > -kRimWrap;
    Lanes key{}, rim{};
    if (BitsOf(facing) != 0) Take(facing, KeyVisibility(facing, start, kKeyLift * stride), key);
    if (BitsOf(behind) != 0) {
      const Eigen::Vector3f& way = studio_.rim_;
      Take(behind, ConeVisibility(start, {All(way.x()), All(way.y()), All(way.z())}), rim);
    }
    const Colors ambient = Ambient(p, normal);
    for (std::size_t k = 0; k <= last; ++k)
      lighting[k] = {key[k], rim[k], {ambient[0][k], ambient[1][k], ambient[2][k]}};
  }

  /// Share of the key light, 0 to 1, that reaches the places in `mask`; `lift` voxels are left out
  /// at its beginning.
  LASCAUX_INLINE Lanes KeyVisibility(const LaneMask& mask, const LanePoint& p, float lift) const {
    const Eigen::Vector3f& way = studio_.key_;
    Lanes light = All(1), t = All(lift);
    // Above the model nothing is in the way.
    const Lanes end =
        Min((coarse_.coarse.high().y() - p.y) / way.y(), All(kKeyReach * studio_.size_));
    for (int step = 0; step < kKeySteps; ++step) {
      const LaneMask on_way = mask & (t < end) & (light > kDark);
      if (BitsOf(on_way) == 0) break;
      const Lanes distance = coarse_.At(Along(p, t, way));
      // Half of the lamp is hidden where the ray just touches the model.
      Take(on_way, Min(light, 0.5F + 0.5F * distance / (kKeySize * t)), light);
      Take(on_way, t + Max(kKeyStep * distance, All(kLeastKeyStep * studio_.size_)), t);
    }
    return Smooth(light);
  }

  /// Share of a cone of half angle about 30 degrees that is free, weighted towards near obstacles.
  LASCAUX_INLINE Lanes ConeVisibility(const LanePoint& p, const LanePoint& way) const {
    Lanes free = All(1);
    for (const float t : studio_.reach_) {
      const Lanes distance = coarse_.At(Along(p, All(t), way));
      free = Min(free, Max(distance, Lanes{}) / (kConeTangent * t));
    }
    return Smooth(free);
  }

  /// How close the model is above places on the floor, 0 to 1: round and without directions.
  LASCAUX_INLINE Lanes Contact(const LanePoint& p) const {
    constexpr int kHeights = 6;
    constexpr float kFirst = 0.012F, kGrowth = 1.7F;  // of the model's size
    Lanes contact{};
    float total = 0, height = kFirst * studio_.size_;
    for (int i = 0; i < kHeights; ++i, height *= kGrowth) {
      const float weight = 1 / (1 + 0.25F * static_cast<float>(i));
      const Lanes distance = Max(coarse_.At({p.x, p.y + height, p.z}), Lanes{});
      contact += weight * Smooth(1 - distance / (1.25F * height));
      total += weight;
    }
    return contact / total;
  }

  /// All that comes from the sky and the floor.
  LASCAUX_INLINE Colors Ambient(const LanePoint& p, const LanePoint& normal) const {
    static const std::array<Cone, 6> kCones = MakeCones();
    const Camera& camera = *studio_.camera_;
    // The smallest rotation that takes the direction to the camera to the normal: continuous over
    // all that can be seen.
    const LanePoint n{Dot(normal, camera.right()), Dot(normal, camera.up()),
                      -Dot(normal, camera.forward())};
    const Lanes a = 1 / (1 + Max(n.z, All(-0.99F)));
    const Lanes b = -n.x * n.y * a;
    const LanePoint u{1 - n.x * n.x * a, b, -n.x}, v{b, 1 - n.y * n.y * a, -n.y};
    Colors light{};
    for (const Cone& cone : kCones) {
      const Eigen::Vector3f& c = cone.direction;
      const LanePoint flat{c.x() * u.x + c.y() * v.x, c.x() * u.y + c.y() * v.y,
                           c.x() * u.z + c.y() * v.z};
      const LanePoint local = Along(flat, All(c.z()), n);
      const LanePoint sideways = Along(LanePoint{}, local.x, camera.right());
      const LanePoint way =
          Along(Along(sideways, local.y, camera.up()), -local.z, camera.forward());
      const Lanes free = kLeastFree + (1 - kLeastFree) * ConeVisibility(p, way);
      const Colors from = LightFrom(way.y, p.y);
      for (std::size_t i = 0; i < 3; ++i) light[i] += cone.weight * free * from[i];
    }
    return light;
  }

  /// What comes from directions of this slope to places of this height.
  LASCAUX_INLINE Colors LightFrom(const Lanes& slope, const Lanes& y) const {
    // The floor is darker under the model, where its light is kept away.
    const Lanes above = Max(y - studio_.ground(), Lanes{}) / studio_.size_;
    const Lanes lit = kDarkestFloor + (1 - kDarkestFloor) * Smooth(above / kFloorReach);
    const Lanes up = Max(slope, Lanes{}), down = Smooth(-2.5F * slope);
    Colors from;
    for (std::size_t i = 0; i < 3; ++i)
      from[i] = kHorizon[i] + up * (kSky[i] - kHorizon[i]) + down * (lit * kFloor[i] - kHorizon[i]);
    return from;
  }

  const Studio& studio_;
  CoarseLanes coarse_;
};

namespace {

// The same code twice; see ray_march.cpp.
void GatherBaseline(const LightLanes& lights, std::span<const Sample> samples,
                    std::span<Lighting> lighting) {
  lights.Gather(samples, lighting);
}
void ShadeBaseline(const LightLanes& lights, std::span<const Eigen::Vector2f> places,
                   std::span<float> shadow) {
  lights.FloorShadow(places, shadow);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] void GatherAvx2(const LightLanes& lights, std::span<const Sample> samples,
                                        std::span<Lighting> lighting) {
  lights.Gather(samples, lighting);
}
[[gnu::target("avx2")]] void ShadeAvx2(const LightLanes& lights,
                                       std::span<const Eigen::Vector2f> places,
                                       std::span<float> shadow) {
  lights.FloorShadow(places, shadow);
}
#else
constexpr auto GatherAvx2 = GatherBaseline;
constexpr auto ShadeAvx2 = ShadeBaseline;
#endif

}  // namespace

std::vector<Lighting> Studio::Gather(std::span<const Sample> samples) const {
  std::vector<Lighting> lighting(samples.size());
  (BestIsa() == Isa::kBaseline ? GatherBaseline : GatherAvx2)(LightLanes(*this), samples, lighting);
  return lighting;
}

std::vector<float> Studio::FloorShadow(std::span<const Eigen::Vector2f> places) const {
  std::vector<float> shadow(places.size());
  (BestIsa() == Isa::kBaseline ? ShadeBaseline : ShadeAvx2)(LightLanes(*this), places, shadow);
  return shadow;
}

}  // namespace lascaux

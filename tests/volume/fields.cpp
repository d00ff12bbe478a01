#include "volume/fields.h"

#include <random>

namespace lascaux::testing {
namespace {

using Eigen::Vector3d;

// The cap recipe: a point beyond each end makes the chain end in about a hemisphere.
constexpr double kCapShift = 0.1389, kCapRadius = 0.7659, kCapWeight = 0.9925;

FieldChain Capped(Segment s) {
  const Vector3d along = (s.b - s.a).normalized();
  s.a -= kCapShift * s.radius_a * along;
  s.b += kCapShift * s.radius_b * along;
  return {{s},
          {{s.a, kCapRadius * s.radius_a, kCapWeight}, {s.b, kCapRadius * s.radius_b, kCapWeight}}};
}

FieldPart Part(const Segment& segment, std::optional<int> parent) {
  FieldPart part;
  part.chains = {Capped(segment)};
  part.parent = parent;
  return part;
}

}  // namespace

Field SphereField(const Vector3d& center, double radius) {
  Field field;
  field.parts.emplace_back().chains.push_back({{}, {{center, radius, 1}}});
  return field;
}

Field CylinderField(const Vector3d& a, const Vector3d& b, double radius) {
  Field field;
  field.parts.emplace_back().chains.push_back({{{a, b, radius, radius}}, {}});
  return field;
}

Field AnimalField() {
  Field field;
  field.parts.push_back(Part({{-1, 0, 0}, {1, 0.1, 0}, 0.45, 0.55}, std::nullopt));
  field.parts.push_back(Part({{0.9, 0.2, 0}, {1.5, 0.9, 0}, 0.35, 0.25}, 0));
  for (const double z : {0.35, -0.35}) {
    field.parts.push_back(Part({{-0.8, -0.1, z}, {-0.9, -1.1, z}, 0.2, 0.12}, 0));
    field.parts.push_back(Part({{0.8, -0.1, z}, {0.75, -1.1, z}, 0.2, 0.12}, 0));
  }
  return field;
}

Field RandomField(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Field field;
  const int count = 1 + static_cast<int>(random() % 6);
  for (int p = 0; p < count; ++p) {
    const Vector3d a(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Vector3d b = a + Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    std::optional<int> parent;
    if (p > 0 && random() % 3 != 0) parent = static_cast<int>(random() % static_cast<unsigned>(p));
    field.parts.push_back(Part({a, b, uniform(0.15, 0.6), uniform(0.15, 0.6)}, parent));
    field.parts.back().z0 = uniform(-0.5, 0.5);
    field.parts.back().depth_scale = uniform(0.6, 1.4);
  }
  return field;
}

Field WithoutMirror(Field field) {
  field.parts.emplace_back().z0 = 1;
  return field;
}

}  // namespace lascaux::testing

#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>

#include "lascaux/field/field.h"

/// @file
/// Seeded random cases for tests: the same on every machine, each failure naming its seed.

namespace lascaux::testing {

/// Random numbers that do not depend on the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15u + 1) {}

  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  /// low <= result <= high.
  int Integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool Chance(double probability) { return Uniform(0, 1) < probability; }

  Eigen::Vector3d InBox(const Eigen::AlignedBox3d& box) {
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) p[i] = Uniform(box.min()[i], box.max()[i]);
    return p;
  }
  Eigen::Vector3d Direction() {
    const double z = Uniform(-1, 1), angle = Uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

/// Calls `body(random)` with a generator for each of the seeds 0 to count - 1; stops at the first
/// seed that fails fatally, and every failure says which seed it was.
template <typename Body>
void ForSeeds(int count, Body body) {
  for (int seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(static_cast<std::uint64_t>(seed));
    body(random);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

/// A segment of radii between 0.3 and 3, of any length up to 10 and any slope up to `steepest`.
inline Segment RandomSegment(Random& random, double steepest = 1) {
  Segment segment;
  segment.a =
      5 * Eigen::Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
  const double length = random.LogUniform(0.05, 10);
  segment.b = segment.a + length * random.Direction();
  segment.radius_a = random.LogUniform(0.3, 3);
  const double slope = random.Uniform(-steepest, steepest);
  segment.radius_b = std::max(segment.radius_a + slope * length, 0.1 * segment.radius_a);
  if (random.Chance(0.5)) {
    std::swap(segment.a, segment.b);
    std::swap(segment.radius_a, segment.radius_b);
  }
  return segment;
}

/// A point at up to 2.2 radii from a place on the segment: mostly within its support.
inline Eigen::Vector3d PointNear(Random& random, const Segment& segment) {
  const double t = random.Uniform(0, 1);
  const double radius = segment.radius_a + t * (segment.radius_b - segment.radius_a);
  return segment.a + t * (segment.b - segment.a) +
         random.Uniform(0, 2.2) * radius * random.Direction();
}

/// A wandering polyline in a plane of constant z, radii changing on the way, with points at both
/// ends.
inline FieldChain RandomChain(Random& random, const Eigen::Vector3d& start, double radius) {
  FieldChain chain;
  Eigen::Vector3d at = start;
  double angle = random.Uniform(0, 2 * std::numbers::pi);
  double here = radius;
  chain.points.push_back({at, 0.77 * here, 0.99});
  const int count = random.Integer(1, 8);
  for (int i = 0; i < count; ++i) {
    const double length = here * random.LogUniform(0.2, 4);
    angle += random.Uniform(-0.8, 0.8);
    const Eigen::Vector3d next = at + length * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    const double there =
        std::clamp(here + random.Uniform(-0.6, 0.6) * length, 0.2 * radius, 2 * radius);
    chain.segments.push_back({at, next, here, there});
    at = next;
    here = there;
  }
  chain.points.push_back({at, 0.77 * here, 0.99});
  return chain;
}

/// A body with limbs in pairs, limbs on limbs, islands and flattened parts, about 20 across.
inline Field RandomCreature(Random& random) {
  Field field;
  field.chain_exponent = random.Chance(0.7) ? 4 : random.Integer(1, 8);
  field.part_exponent = random.Chance(0.7) ? 4 : random.Integer(1, 8);
  const int parts = random.Integer(1, 7);
  for (int i = 0; i < parts; ++i) {
    FieldPart part;
    double radius = random.LogUniform(0.5, 2);
    Eigen::Vector3d start(random.Uniform(-8, 8), random.Uniform(-5, 5), 0);
    if (i > 0 && random.Chance(0.85)) {
      part.parent = random.Integer(0, i - 1);
      const FieldPart& parent = field.parts[static_cast<std::size_t>(*part.parent)];
      const Segment& host = parent.chains[0].segments[0];
      start = host.a + random.Uniform(0, 1) * (host.b - host.a);
      start.z() = parent.z0 + random.Uniform(0, 1) * host.radius_a;
      radius = host.radius_a * random.LogUniform(0.15, 0.7);
    }
    part.z0 = start.z();
    part.depth_scale = random.Chance(0.5) ? 1 : random.LogUniform(0.4, 1.5);
    const int chains = random.Integer(1, 3);
    for (int k = 0; k < chains; ++k) {
      part.chains.push_back(RandomChain(random, start, radius * (k == 0 ? 1 : 0.6)));
    }
    field.parts.push_back(part);
    if (part.parent && part.z0 != 0 && random.Chance(0.5)) {
      part.z0 = -part.z0;
      for (FieldChain& chain : part.chains) {
        for (Segment& segment : chain.segments) segment.a.z() *= -1, segment.b.z() *= -1;
        for (PointPrimitive& point : chain.points) point.center.z() *= -1;
      }
      field.parts.push_back(part);
    }
  }
  return field;
}

}  // namespace lascaux::testing

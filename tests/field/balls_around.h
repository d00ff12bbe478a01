#pragma once

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "lascaux/field/compiled_field.h"
#include "support/cases.h"

namespace lascaux::testing {

/// Expects of bounds on eight balls around a random place what bounds on each of them say.
inline void ExpectBoundsAroundAsOnEach(Random& random, const CompiledField& field) {
  BallsAround balls;
  balls.center = random.InBox(field.bounds());
  balls.offset = random.LogUniform(0.01, 2);
  balls.radius = balls.offset * random.Uniform(0.5, 3);
  balls.inner = balls.radius * random.Uniform(0.2, 1);
  const BoundsAround around = field.BoundOnBalls(balls, field.All());
  const auto expect_near = [](const FieldBounds& found, const FieldBounds& expected) {
    EXPECT_NEAR(found.lower, expected.lower, 1e-3 * expected.lower + 1e-4);
    EXPECT_NEAR(found.upper, expected.upper, 1e-3 * expected.upper + 1e-4);
  };
  for (std::size_t k = 0; k < around.bounds.size(); ++k) {
    const auto way = [k](std::size_t bit) { return (k & bit) != 0 ? 1.0 : -1.0; };
    const Eigen::Vector3d center =
        balls.center + balls.offset * Eigen::Vector3d(way(4), way(2), way(1));
    const BallBounds each = field.BoundOnBall({center, balls.radius}, field.All());
    expect_near(around.bounds[k], each.bounds);
    if (each.bounds.lower < 0.999 && each.bounds.upper > 1.001)
      expect_near(around.inner[k], field.BoundOnBall({center, balls.inner}, field.All()).bounds);
    std::array<float, 64> x, y, z, values, expected;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Eigen::Vector3f offset =
          (balls.radius * random.Uniform(0, 1) * random.Direction()).cast<float>();
      x[i] = offset.x(), y[i] = offset.y(), z[i] = offset.z();
    }
    field.EvaluateValues({center, x, y, z}, around.Active(k), values);
    field.EvaluateValues({center, x, y, z}, field.All(), expected);
    EXPECT_EQ(values, expected);
  }
}

}  // namespace lascaux::testing

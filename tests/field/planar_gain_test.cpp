#include "lascaux/field/planar_gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "balls_around.h"
#include "lascaux/field/compiled_field.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::ForSeeds;
using testing::Random;

PlanarGain RandomGain(Random& random) {
  PlanarGain gain;
  gain.origin = {random.Uniform(-8, -4), random.Uniform(-8, -4)};
  gain.cell = random.Uniform(0.2, 1);
  gain.columns = random.Integer(5, 30);
  gain.rows = random.Integer(5, 30);
  for (int i = 0; i < gain.columns * gain.rows; ++i) {
    gain.coefficients.push_back(random.Chance(0.5) ? 0.0f
                                                   : static_cast<float>(random.Uniform(-0.5, 0.5)));
  }
  return gain;
}

Vector2d Near(const PlanarGain& gain, Random& random) {
  return gain.origin + gain.cell * Vector2d(random.Uniform(-4, gain.columns + 3),
                                            random.Uniform(-4, gain.rows + 3));
}

TEST(PlanarGain, EvenTableIsItsValueInside) {
  const PlanarGain gain{{1, 2}, 0.5, 9, 9, std::vector<float>(81, 0.25f)};
  const LogGain middle = EvaluateLogGain(gain, {3, 4});
  EXPECT_NEAR(middle.value, 0.25, 1e-7);
  EXPECT_NEAR(middle.gradient.norm(), 0, 1e-6);
  EXPECT_EQ(EvaluateLogGain(gain, {-1, 4}).value, 0);
  EXPECT_EQ(EvaluateLogGain(gain, {1e300, -1e300}).value, 0);
}

TEST(PlanarGain, GradientAgreesWithDifferences) {
  ForSeeds(300, [](Random& random) {
    const PlanarGain gain = RandomGain(random);
    const Vector2d p = Near(gain, random);
    const LogGain here = EvaluateLogGain(gain, p);
    constexpr double kStep = 1e-5;
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2d step = kStep * Vector2d::Unit(axis);
      const double difference =
          (EvaluateLogGain(gain, p + step).value - EvaluateLogGain(gain, p - step).value) /
          (2 * kStep);
      EXPECT_NEAR(here.gradient[axis], difference, 1e-6);
    }
  });
}

TEST(PlanarGain, FieldIsMultipliedByItInBothPrecisions) {
  ForSeeds(60, [](Random& random) {
    Field field = testing::RandomCreature(random);
    const Field plain = field;
    field.gain = RandomGain(random);
    const CompiledField compiled(field);
    const Eigen::Vector3d origin(random.Uniform(-4, 4), random.Uniform(-4, 4),
                                 random.Uniform(-1, 1));
    std::vector<float> x, y, z;
    for (int i = 0; i < 64; ++i) {
      x.push_back(static_cast<float>(random.Uniform(-1, 1)));
      y.push_back(static_cast<float>(random.Uniform(-1, 1)));
      z.push_back(static_cast<float>(random.Uniform(-1, 1)));
    }
    std::vector<float> f(64), gx(64), gy(64), gz(64), values(64);
    const BallBounds found = compiled.BoundOnBall({origin, 1.8}, compiled.All());
    testing::ExpectBoundsAroundAsOnEach(random, compiled);
    compiled.EvaluateSamples({origin, x, y, z}, found.active, {f, gx, gy, gz});
    compiled.EvaluateValues({origin, x, y, z}, found.active, values);
    for (std::size_t i = 0; i < 64; ++i) {
      const Eigen::Vector3d p =
          origin + Eigen::Vector3d(static_cast<double>(x[i]), static_cast<double>(y[i]),
                                   static_cast<double>(z[i]));
      const FieldSample exact = Evaluate(field, p);
      const double gain = std::exp(EvaluateLogGain(*field.gain, p.head<2>()).value);
      EXPECT_NEAR(exact.value, gain * Evaluate(plain, p).value, 1e-12 * std::max(1.0, exact.value));
      const double tolerance = 2 * kFloatValueError * std::max(1.0, exact.value / 4);
      EXPECT_NEAR(static_cast<double>(f[i]), exact.value, tolerance);
      EXPECT_NEAR(static_cast<double>(values[i]), exact.value, tolerance);
      EXPECT_GE(exact.value, static_cast<double>(found.bounds.lower));
      EXPECT_LE(exact.value, static_cast<double>(found.bounds.upper) + 1e-6);
      const Eigen::Vector3d gradient(static_cast<double>(gx[i]), static_cast<double>(gy[i]),
                                     static_cast<double>(gz[i]));
      EXPECT_LE((gradient - exact.gradient).norm(), 5e-3 * std::max(1.0, exact.gradient.norm()));
    }
  });
}

}  // namespace
}  // namespace lascaux

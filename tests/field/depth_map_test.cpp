#include "lascaux/field/depth_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "balls_around.h"
#include "lascaux/field/compiled_field.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::ForSeeds;
using testing::Random;

/// Middles up to 1 in front of and behind z0 and scales of 0.4 to 1.6, changing over a few cells.
DepthMap RandomMap(Random& random, double z0, const Eigen::AlignedBox2d& box) {
  DepthMap map;
  map.origin = box.min();
  map.columns = random.Integer(1, 12);
  map.rows = random.Integer(1, 12);
  map.cell = box.sizes().maxCoeff() / 8;
  for (int i = 0; i < map.columns * map.rows; ++i) {
    map.middle.push_back(static_cast<float>(z0 + random.Uniform(-1, 1)));
    map.steepness.push_back(static_cast<float>(random.LogUniform(0.6, 2.5)));
  }
  return map;
}

/// A random creature most of whose parts have a map.
Field ShapedCreature(Random& random) {
  Field field = testing::RandomCreature(random);
  const Eigen::AlignedBox3d box = Bounds(field);
  for (FieldPart& part : field.parts) {
    if (random.Chance(0.7)) {
      part.depth = RandomMap(random, part.z0, {box.min().head<2>(), box.max().head<2>()});
    }
  }
  return field;
}

TEST(DepthMap, IsSmoothAndStaysWhatItIsBeyondItsTable) {
  ForSeeds(100, [](Random& random) {
    const Eigen::AlignedBox2d box(Vector2d(-3, -2), Vector2d(4, 5));
    const DepthMap map = RandomMap(random, 0.5, box);
    for (int k = 0; k < 30; ++k) {
      const Vector2d place(random.Uniform(-6, 8), random.Uniform(-6, 8));
      const DepthSample here = EvaluateDepth(map, place);
      for (int i = 0; i < 2; ++i) {
        const double step = 1e-5;
        const DepthSample ahead = EvaluateDepth(map, place + step * Vector2d::Unit(i));
        ASSERT_NEAR(here.middle_gradient[i], (ahead.middle - here.middle) / step, 1e-3);
        ASSERT_NEAR(here.steepness_gradient[i], (ahead.steepness - here.steepness) / step, 1e-3);
      }
    }
    const DepthSample far = EvaluateDepth(map, {-1e9, -1e300});
    EXPECT_NEAR(far.middle, static_cast<double>(map.middle.front()), 1e-12);
    EXPECT_NEAR(far.steepness, static_cast<double>(map.steepness.front()), 1e-12);
    EXPECT_EQ(far.middle_gradient, Vector2d::Zero());
  });
}

TEST(DepthMap, RangesHoldEveryValueOnABox) {
  ForSeeds(100, [](Random& random) {
    const Eigen::AlignedBox2d box(Vector2d(-3, -2), Vector2d(4, 5));
    const DepthMap map = RandomMap(random, 0, box);
    Eigen::AlignedBox2d part(Vector2d(random.Uniform(-6, 8), random.Uniform(-6, 8)));
    part.extend(Vector2d(part.min() + Vector2d(random.Uniform(0, 3), random.Uniform(0, 3))));
    const DepthRange range = RangeOf(map, part);
    for (int k = 0; k < 50; ++k) {
      const Vector2d share(random.Uniform(0, 1), random.Uniform(0, 1));
      const DepthSample here =
          EvaluateDepth(map, part.min() + share.cwiseProduct(Vector2d(part.sizes())));
      ASSERT_GE(here.middle, range.middle_low - 1e-12);
      ASSERT_LE(here.middle, range.middle_high + 1e-12);
      ASSERT_GE(here.steepness, range.steepness_low - 1e-12);
      ASSERT_LE(here.steepness, range.steepness_high + 1e-12);
    }
  });
}

/// The greatest value of a part on the line along z through a place, by golden sections around the
/// best of many.
double GreatestAlongZ(const Field& field, const Vector2d& place, double reach) {
  const auto at = [&](double z) { return EvaluatePart(field, 0, {place.x(), place.y(), z}).value; };
  double best = 0, where = 0;
  for (double z = -reach; z <= reach; z += reach / 500) {
    if (at(z) > best) best = at(z), where = z;
  }
  double low = where - reach / 500, high = where + reach / 500;
  for (int i = 0; i < 60; ++i) {
    const double a = low + 0.4 * (high - low), b = low + 0.6 * (high - low);
    (at(a) < at(b) ? low : high) = at(a) < at(b) ? a : b;
  }
  return std::max(best, at((low + high) / 2));
}

TEST(DepthMap, LeavesTheViewFromTheSideAsItIs) {
  ForSeeds(40, [](Random& random) {
    Field field;
    field.parts.resize(1);
    field.parts[0].chains = {testing::RandomChain(random, Vector3d(0, 0, 0), 1)};
    const Eigen::AlignedBox3d box = Bounds(field);
    Field shaped = field;
    shaped.parts[0].depth = RandomMap(random, 0, {box.min().head<2>(), box.max().head<2>()});
    for (int k = 0; k < 10; ++k) {
      const Vector3d point = random.InBox(box);
      const double flat = EvaluatePart(field, 0, {point.x(), point.y(), 0}).value;
      ASSERT_NEAR(GreatestAlongZ(shaped, point.head<2>(), 5), flat, 1e-6);
    }
  });
}

TEST(DepthMap, GradientIsTheDerivativeOfTheValueAndBoundsHoldTheField) {
  ForSeeds(100, [](Random& random) {
    const Field field = ShapedCreature(random);
    const Eigen::AlignedBox3d box = Bounds(field);
    Eigen::AlignedBox3d larger = box;
    larger.min().array() -= 3;
    larger.max().array() += 3;
    for (int k = 0; k < 20; ++k) {
      const Vector3d outside = random.InBox(larger);
      if (!box.contains(outside)) {
        ASSERT_EQ(Evaluate(field, outside).value, 0);
      }
      const Vector3d point = random.InBox(box);
      const FieldSample sample = Evaluate(field, point);
      for (int i = 0; i < 3; ++i) {
        const double step = 1e-6;
        const Vector3d way = step * Vector3d::Unit(i);
        const double ahead = (Evaluate(field, point + way).value - sample.value) / step;
        const double back = (sample.value - Evaluate(field, point - way).value) / step;
        if (std::abs(ahead - back) > 1e-3) continue;  // a crease of the maximum
        ASSERT_NEAR(sample.gradient[i], (ahead + back) / 2, 1e-5) << sample.value;
      }
    }
  });
}

TEST(DepthMap, BlocksAgreeWithDoublePrecisionAndBallsHoldThem) {
  for (const Isa isa : {Isa::kBaseline, Isa::kAvx2, Isa::kAvx512}) {
    if (!IsSupported(isa)) continue;
    ForSeeds(60, [isa](Random& random) {
      const Field field = ShapedCreature(random);
      const CompiledField compiled(field, isa);
      const double thinnest = compiled.ThinnestRadius(compiled.All());
      const Ball ball{random.InBox(compiled.bounds()), random.LogUniform(0.05, 2)};
      const BallBounds found =
          compiled.BoundOnBall({ball.center, 1.000001 * ball.radius}, compiled.All());
      testing::ExpectBoundsAroundAsOnEach(random, compiled);
      constexpr std::size_t kCount = 100;  // more than a tile
      std::vector<float> x, y, z, f(kCount), gx(kCount), gy(kCount), gz(kCount), values(kCount);
      for (std::size_t i = 0; i < kCount; ++i) {
        const Eigen::Vector3f way =
            (ball.radius * random.Uniform(0, 1) * random.Direction()).cast<float>();
        x.push_back(way.x()), y.push_back(way.y()), z.push_back(way.z());
      }
      compiled.EvaluateSamples({ball.center, x, y, z}, found.active, {f, gx, gy, gz});
      compiled.EvaluateValues({ball.center, x, y, z}, compiled.All(), values);
      for (std::size_t i = 0; i < kCount; ++i) {
        const Vector3d point = ball.center + Vector3d(x[i], y[i], z[i]);
        const FieldSample exact = Evaluate(field, point);
        const double scale = std::max(1.0, exact.value / 4);
        ASSERT_NEAR(f[i], exact.value, kFloatValueError * scale);
        ASSERT_EQ(f[i], values[i]);
        ASSERT_LE(exact.value, found.bounds.upper);
        ASSERT_GE(exact.value, found.bounds.lower);
        const Vector3d gradient(gx[i], gy[i], gz[i]);
        const double error = (gradient - exact.gradient).norm();
        // Where two branches of the maximum cross, either gradient is right.
        if (error * thinnest > kFloatGradientError * scale) {
          const Vector3d way = 1e-4 * (gradient - exact.gradient).normalized();
          ASSERT_GT((Evaluate(field, point + way).gradient - exact.gradient).norm() +
                        (Evaluate(field, point - way).gradient - exact.gradient).norm(),
                    0.5 * error);
        }
      }
    });
  }
}

}  // namespace
}  // namespace lascaux

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "balls_around.h"
#include "lascaux/field/compiled_field.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;
using testing::RandomCreature;

/// Places in a ball, half of them on its sphere, and F there by single-precision code.
class Sprinkle {
 public:
  Sprinkle(Random& random, const Ball& ball, int count) : center_(ball.center) {
    for (int i = 0; i < count; ++i) {
      const double r = ball.radius * (i % 2 == 0 ? 1 : std::cbrt(random.Uniform(0, 1)));
      const Eigen::Vector3f offset = (r * random.Direction()).cast<float>();
      x_.push_back(offset.x());
      y_.push_back(offset.y());
      z_.push_back(offset.z());
    }
  }
  std::vector<Eigen::Vector3d> Points() const {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      points.push_back(center_ + Eigen::Vector3d(x_[i], y_[i], z_[i]));
    }
    return points;
  }
  std::vector<float> Values(const CompiledField& field, const ActiveSet& active) const {
    std::vector<float> values(x_.size());
    field.EvaluateValues({center_, x_, y_, z_}, active, values);
    return values;
  }

 private:
  Eigen::Vector3d center_;
  std::vector<float> x_, y_, z_;
};

/// The relative rounding of single precision: points drawn on a sphere may be this far outside.
constexpr double kRounding = 1 + 1e-6;

TEST(BoundOnBall, HoldsTheFieldAtEveryPointOfTheBall) {
  double tightness = 0;
  int bounded = 0;
  ForSeeds(80, [&](Random& random) {
    const Field field = RandomCreature(random);
    const CompiledField compiled(field);
    for (int k = 0; k < 40; ++k) {
      const Ball ball{random.InBox(compiled.bounds()), random.LogUniform(0.01, 4)};
      const BallBounds found =
          compiled.BoundOnBall({ball.center, ball.radius * kRounding}, compiled.All());
      const Sprinkle sprinkle(random, ball, 30);
      ASSERT_EQ(sprinkle.Values(compiled, found.active), sprinkle.Values(compiled, compiled.All()));
      double largest = 0;
      for (const Eigen::Vector3d& point : sprinkle.Points()) {
        const double value = Evaluate(field, point).value;
        largest = std::max(largest, value);
        ASSERT_LE(value, found.bounds.upper) << "ball " << ball.radius;
        ASSERT_GE(value, found.bounds.lower) << "ball " << ball.radius;
      }
      if (largest > 0.2 && ball.radius < 0.3) {
        tightness += found.bounds.upper / largest;
        ++bounded;
      }
    }
  });
  // What the bounds are worth: loose ones would be right as well, and useless.
  EXPECT_LT(tightness / bounded, 1.3);
}

/// The rasteriser's descent: blocks of 64 voxels, cut in eight until they have 8, lists shrinking
/// on the way.
class Descent {
 public:
  Descent(const Field& field, double voxel) : compiled_(field), voxel_(voxel) {}

  void Run() {
    const Eigen::AlignedBox3d& box = compiled_.bounds();
    const double side = 64 * voxel_;
    for (double x = box.min().x(); x < box.max().x(); x += side) {
      for (double y = box.min().y(); y < box.max().y(); y += side) {
        for (double z = box.min().z(); z < box.max().z(); z += side) {
          Visit({x, y, z}, 64, compiled_.All());
        }
      }
    }
  }
  int evaluated = 0, crossing = 0, skipped = 0;

 private:
  void Visit(const Eigen::Vector3d& corner, int voxels, const ActiveSet& active) {
    const double side = voxels * voxel_;
    const Eigen::Vector3d center = corner + Eigen::Vector3d::Constant(side / 2);
    const BallBounds found = compiled_.BoundOnBall({center, std::sqrt(3.0) / 2 * side}, active);
    const bool outside = found.bounds.upper<kIsoValue, inside = found.bounds.lower> kIsoValue;
    if (outside || inside) {
      CheckSkipped(corner, voxels, outside);
      return;
    }
    if (voxels == 8) {
      ++evaluated;
      crossing += Crosses(corner, found.active);
      return;
    }
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d step(i & 1, (i >> 1) & 1, (i >> 2) & 1);
      Visit(corner + side / 2 * step, voxels / 2, found.active);
    }
  }

  /// Dense evaluation on every voxel's corner, the far faces included.
  std::vector<float> Dense(const Eigen::Vector3d& corner, int voxels,
                           const ActiveSet& active) const {
    std::vector<float> x, y, z;
    for (int i = 0; i <= voxels; ++i) {
      for (int j = 0; j <= voxels; ++j) {
        for (int k = 0; k <= voxels; ++k) {
          x.push_back(static_cast<float>(i * voxel_));
          y.push_back(static_cast<float>(j * voxel_));
          z.push_back(static_cast<float>(k * voxel_));
        }
      }
    }
    std::vector<float> values(x.size());
    compiled_.EvaluateValues({corner, x, y, z}, active, values);
    return values;
  }
  bool Crosses(const Eigen::Vector3d& corner, const ActiveSet& active) const {
    const std::vector<float> values = Dense(corner, 8, active);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *low <= 1 && *high >= 1;
  }
  void CheckSkipped(const Eigen::Vector3d& corner, int voxels, bool outside) {
    ++skipped;
    const std::vector<float> values = Dense(corner, voxels, compiled_.All());
    for (const float value : values) ASSERT_EQ(value < 1, outside) << value;
  }

  CompiledField compiled_;
  double voxel_;
};

TEST(BoundOnBall, NoBlockThatHoldsSurfaceIsSkippedOnTheWayFromCoarseToFine) {
  int evaluated = 0, crossing = 0, skipped = 0;
  ForSeeds(6, [&](Random& random) {
    const Field field = RandomCreature(random);
    Descent descent(field, Bounds(field).sizes().maxCoeff() / 120);
    descent.Run();
    evaluated += descent.evaluated;
    crossing += descent.crossing;
    skipped += descent.skipped;
  });
  EXPECT_GT(crossing, 1000);
  EXPECT_LT(evaluated, 2 * crossing);
  EXPECT_GT(skipped, 1000);
}

TEST(BoundOnBall, ListsOfBallsInsideOfABallMayStartFromItsList) {
  ForSeeds(50, [](Random& random) {
    const Field field = RandomCreature(random);
    const CompiledField compiled(field);
    const Ball outer{random.InBox(compiled.bounds()), random.LogUniform(0.5, 4)};
    const ActiveSet list = compiled.BoundOnBall(outer, compiled.All()).active;
    for (int k = 0; k < 20; ++k) {
      const double radius = 0.3 * outer.radius;
      const Ball inner{outer.center + random.Uniform(0, 0.7) * outer.radius * random.Direction(),
                       radius};
      const BallBounds found = compiled.BoundOnBall({inner.center, radius * kRounding}, list);
      const Sprinkle sprinkle(random, inner, 10);
      ASSERT_EQ(sprinkle.Values(compiled, found.active), sprinkle.Values(compiled, compiled.All()));
      for (const Eigen::Vector3d& point : sprinkle.Points()) {
        const double value = Evaluate(field, point).value;
        ASSERT_LE(value, found.bounds.upper);
        ASSERT_GE(value, found.bounds.lower);
      }
    }
  });
}

TEST(BoundOnBall, IsTightOnAPoint) {
  ForSeeds(100, [](Random& random) {
    const Field field = RandomCreature(random);
    const CompiledField compiled(field);
    const Eigen::Vector3d point = random.InBox(compiled.bounds());
    const BallBounds found = compiled.BoundOnBall({point, 0}, compiled.All());
    const double value = Evaluate(field, point).value;
    EXPECT_NEAR(found.bounds.lower, value, 2e-3 * value + 1e-4);
    EXPECT_NEAR(found.bounds.upper, value, 2e-3 * value + 1e-4);
  });
}

TEST(BoundOnBall, HoldsForTipsAndSteepSegments) {
  ForSeeds(300, [](Random& random) {
    Segment segment = testing::RandomSegment(random, 1.5);
    if (random.Chance(0.5)) segment.radius_b = 0;
    Field field;
    field.parts.emplace_back();
    field.parts[0].chains.push_back({{segment}, {}});
    const CompiledField compiled(field);
    for (int k = 0; k < 30; ++k) {
      Ball ball{testing::PointNear(random, segment), random.LogUniform(1e-4, 3)};
      if (k % 2 == 0) {
        // Within the reach of the last piece of a tip, whose radii have no ratio.
        const double reach = kTipRadius * std::max(segment.radius_a, segment.radius_b);
        ball = {segment.b + reach * random.LogUniform(1e-3, 1) * random.Direction(),
                reach * random.LogUniform(1e-6, 1)};
      }
      const BallBounds found = compiled.BoundOnBall(ball, compiled.All());
      for (int i = 0; i < 20; ++i) {
        const double value =
            Evaluate(field, ball.center + random.Uniform(0, ball.radius) * random.Direction())
                .value;
        ASSERT_LE(value, found.bounds.upper);
        ASSERT_GE(value, found.bounds.lower);
      }
    }
  });
}

TEST(BoundOnBalls, SaysWhatBoundsOnEachOfThemSay) {
  ForSeeds(300, [](Random& random) {
    Field field = RandomCreature(random);
    for (FieldPart& part : field.parts) {
      if (random.Chance(0.3)) part.chains[0].segments.back().radius_b = 0;  // a tip
    }
    const CompiledField compiled(field);
    for (int k = 0; k < 5; ++k) testing::ExpectBoundsAroundAsOnEach(random, compiled);
  });
}

}  // namespace
}  // namespace lascaux

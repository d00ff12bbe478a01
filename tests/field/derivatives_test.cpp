#include "lascaux/field/derivatives.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::PointNear;
using testing::Random;
using testing::RandomSegment;

constexpr double kStep = 1e-5;
constexpr double kDifferenceError = 2e-7;  ///< of the differences themselves, with radii near 1

/// Fourth-order difference of value(step).
template <typename Value>
double Difference(Value value) {
  return (8 * (value(kStep) - value(-kStep)) - (value(2 * kStep) - value(-2 * kStep))) /
         (12 * kStep);
}

TEST(Derivatives, OfSegmentsAgreeWithDifferences) {
  ForSeeds(1000, [](Random& random) {
    const Segment segment = RandomSegment(random);
    const Eigen::Vector3d point = PointNear(random, segment);
    const SegmentDerivatives found = Differentiate(segment, point);
    EXPECT_EQ(found.sample.value, Evaluate(segment, point).value);
    EXPECT_LE((found.sample.gradient - Evaluate(segment, point).gradient).norm(), 1e-14);
    const double tolerance = kDifferenceError * (1 + 1 / (segment.b - segment.a).norm());
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
      ASSERT_NEAR(found.d_a[i], Difference([&](double h) {
                    return Evaluate(Segment{segment.a + h * axis, segment.b, segment.radius_a,
                                            segment.radius_b},
                                    point)
                        .value;
                  }),
                  tolerance);
      ASSERT_NEAR(found.d_b[i], Difference([&](double h) {
                    return Evaluate(Segment{segment.a, segment.b + h * axis, segment.radius_a,
                                            segment.radius_b},
                                    point)
                        .value;
                  }),
                  tolerance);
    }
    ASSERT_NEAR(found.d_radius_a, Difference([&](double h) {
                  return Evaluate(
                             Segment{segment.a, segment.b, segment.radius_a + h, segment.radius_b},
                             point)
                      .value;
                }),
                tolerance);
    ASSERT_NEAR(found.d_radius_b, Difference([&](double h) {
                  return Evaluate(
                             Segment{segment.a, segment.b, segment.radius_a, segment.radius_b + h},
                             point)
                      .value;
                }),
                tolerance);
  });
}

TEST(Derivatives, OfSegmentsObeyTranslationAndScale) {
  ForSeeds(1000, [](Random& random) {
    const Segment segment = RandomSegment(random);
    const Eigen::Vector3d point = PointNear(random, segment);
    const SegmentDerivatives found = Differentiate(segment, point);
    EXPECT_LE((found.d_a + found.d_b + found.sample.gradient).norm(),
              1e-13 * (1 + found.d_a.norm()));
    const double sum = point.dot(found.sample.gradient) + segment.a.dot(found.d_a) +
                       segment.b.dot(found.d_b) + segment.radius_a * found.d_radius_a +
                       segment.radius_b * found.d_radius_b;
    EXPECT_NEAR(sum, 0, 1e-11 * (1 + found.d_a.norm() * segment.a.norm()));
  });
}

TEST(Derivatives, OfPointsAgreeWithDifferences) {
  ForSeeds(500, [](Random& random) {
    const PointPrimitive primitive{random.Direction(), random.LogUniform(0.5, 2),
                                   random.Uniform(0.5, 1)};
    const Eigen::Vector3d point =
        primitive.center + random.Uniform(0, 2.1) * primitive.radius * random.Direction();
    const PointDerivatives found = Differentiate(primitive, point);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
      EXPECT_NEAR(found.d_center[i], Difference([&](double h) {
                    return Evaluate(PointPrimitive{primitive.center + h * axis, primitive.radius,
                                                   primitive.weight},
                                    point)
                        .value;
                  }),
                  kDifferenceError);
    }
    EXPECT_NEAR(
        found.d_radius, Difference([&](double h) {
          return Evaluate(PointPrimitive{primitive.center, primitive.radius + h, primitive.weight},
                          point)
              .value;
        }),
        kDifferenceError);
    EXPECT_NEAR(
        found.d_weight, Difference([&](double h) {
          return Evaluate(PointPrimitive{primitive.center, primitive.radius, primitive.weight + h},
                          point)
              .value;
        }),
        kDifferenceError);
  });
}

TEST(Derivatives, AreZeroForASegmentOfLengthZeroAndOutsideOfTheSupport) {
  const Segment nothing{Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 0, 0), 1, 2};
  EXPECT_EQ(Differentiate(nothing, {1, 0.5, 0}).d_a.norm(), 0);
  const Segment far{Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, 0, 0), 1, 2};
  EXPECT_EQ(Differentiate(far, {1, 50, 0}).d_radius_b, 0);
}

}  // namespace
}  // namespace lascaux

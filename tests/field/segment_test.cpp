#include <gtest/gtest.h>

#include <cmath>

#include "field/quadrature.h"
#include "lascaux/field/primitives.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::PointNear;
using testing::Random;
using testing::RandomSegment;
using testing::Reference;
using testing::SegmentReference;

/// Errors of one evaluation, in units of their bounds.
void ExpectAccurate(const Segment& segment, const Eigen::Vector3d& point) {
  const Reference exact = SegmentReference(segment, point).Sample();
  const FieldSample found = Evaluate(segment, point);
  const double value = static_cast<double>(exact.value);
  const Eigen::Vector3d gradient = exact.gradient.cast<double>();
  const double radius = std::max(segment.radius_a, segment.radius_b);
  ASSERT_LE(std::abs(found.value - value), kSegmentValueError * std::max(value, 0.05))
      << value << " slope "
      << (segment.radius_b - segment.radius_a) / (segment.b - segment.a).norm();
  ASSERT_LE((found.gradient - gradient).norm(),
            kSegmentGradientError * (gradient.norm() + 0.05 / radius))
      << gradient.transpose();
}

Segment WithSlope(double slope, double length) {
  return {Eigen::Vector3d(0.3, -0.2, 0.1),
          Eigen::Vector3d(0.3, -0.2, 0.1) + length * Eigen::Vector3d(2, 3, 6) / 7, 1.0,
          1.0 + slope * length};
}

TEST(Segment, LongSegmentIsACylinderOfItsRadius) {
  for (double radius : {1e-9, 0.3, 1.0, 7e8}) {
    const Segment segment{Eigen::Vector3d(-10 * radius, 0, 0), Eigen::Vector3d(10 * radius, 0, 0),
                          radius, radius};
    const FieldSample sample = Evaluate(segment, {0.1 * radius, 0, radius});
    EXPECT_NEAR(sample.value, 1, 1e-14);
    EXPECT_NEAR(sample.gradient.z() * radius, -7.0 / 3, 1e-13);
    EXPECT_NEAR(Evaluate(segment, Eigen::Vector3d::Zero()).value, std::pow(4.0 / 3, 3.5), 1e-14);
    EXPECT_EQ(Evaluate(segment, {0, 2 * radius, 0}).value, 0);
  }
}

TEST(Segment, FieldAtTheEndOfALongSegmentIsHalfOfWhatItIsInside) {
  const Segment segment{Eigen::Vector3d::Zero(), Eigen::Vector3d(20, 0, 0), 1, 1};
  EXPECT_NEAR(Evaluate(segment, {0, 1, 0}).value, 0.5, 1e-14);
  EXPECT_NEAR(Evaluate(segment, {0, 0, 0}).value, std::pow(4.0 / 3, 3.5) / 2, 1e-14);
}

TEST(Segment, ValueAndGradientAgreeWithQuadratureForRandomSegments) {
  ForSeeds(3000, [](Random& random) {
    const Segment segment = RandomSegment(random);
    ExpectAccurate(segment, PointNear(random, segment));
  });
}

TEST(Segment, ValueAndGradientAgreeWithQuadratureForEverySlope) {
  const double slopes[] = {0,    1e-14,        1e-10, 1e-7,         1e-4, 0.06,
                           0.35, 0.4999999999, 0.5,   0.5000000001, 0.8,  1};
  ForSeeds(60, [&](Random& random) {
    for (double slope : slopes) {
      const double length = random.LogUniform(0.01, 30);
      const Segment segment = WithSlope(slope, length);
      ExpectAccurate(segment, PointNear(random, segment));
      ExpectAccurate({segment.b, segment.a, segment.radius_b, segment.radius_a},
                     PointNear(random, segment));
    }
  });
}

TEST(Segment, ValueAndGradientAgreeWithQuadratureOnTheAxis) {
  ForSeeds(500, [](Random& random) {
    const Segment segment = RandomSegment(random);
    const double t = random.Uniform(-0.5, 1.5);
    ExpectAccurate(segment, segment.a + t * (segment.b - segment.a));
    ExpectAccurate(segment, segment.a);
    ExpectAccurate(segment, segment.b);
  });
}

TEST(Segment, ValueAndGradientAgreeWithQuadratureNearTips) {
  ForSeeds(500, [](Random& random) {
    Segment segment = RandomSegment(random);
    segment.radius_b = random.Chance(0.5) ? 0 : segment.radius_a * random.LogUniform(1e-3, 1e-1);
    Eigen::Vector3d point = PointNear(random, segment);
    if ((point - segment.b).norm() < 1e-3 * segment.radius_a) point = segment.a;
    ExpectAccurate(segment, point);
    // Behind the tip and towards it.
    const double distance = segment.radius_a * random.LogUniform(1e-3, 1);
    ExpectAccurate(segment, segment.b + distance * random.Direction());
  });
}

TEST(Segment, ValueAndGradientAgreeWithQuadratureAtExtremeScales) {
  ForSeeds(500, [](Random& random) {
    Segment segment = RandomSegment(random);
    const Eigen::Vector3d point = PointNear(random, segment);
    const double scale = random.LogUniform(1e-12, 1e12);
    const Segment scaled{scale * segment.a, scale * segment.b, scale * segment.radius_a,
                         scale * segment.radius_b};
    ExpectAccurate(scaled, scale * point);
  });
}

TEST(Segment, ScaleChangesNothing) {
  ForSeeds(1000, [](Random& random) {
    const Segment segment = RandomSegment(random);
    const Eigen::Vector3d point = PointNear(random, segment);
    const double value = Evaluate(segment, point).value;
    const double scale = random.LogUniform(1e-20, 1e20);
    const Segment scaled{scale * segment.a, scale * segment.b, scale * segment.radius_a,
                         scale * segment.radius_b};
    EXPECT_NEAR(Evaluate(scaled, scale * point).value, value, 1e-12);
  });
}

TEST(Segment, PiecesOfASegmentAddUpToIt) {
  ForSeeds(1000, [](Random& random) {
    const Segment whole = RandomSegment(random);
    const Eigen::Vector3d point = PointNear(random, whole);
    const double t = random.Uniform(0, 1);
    const Eigen::Vector3d middle = whole.a + t * (whole.b - whole.a);
    const double radius = whole.radius_a + t * (whole.radius_b - whole.radius_a);
    const FieldSample all = Evaluate(whole, point);
    const FieldSample first = Evaluate(Segment{whole.a, middle, whole.radius_a, radius}, point);
    const FieldSample second = Evaluate(Segment{middle, whole.b, radius, whole.radius_b}, point);
    EXPECT_NEAR(first.value + second.value, all.value, 1e-11);
    EXPECT_LE((first.gradient + second.gradient - all.gradient).norm(),
              1e-10 * (1 + all.gradient.norm()));
  });
}

TEST(Segment, FieldIsNeverNegativeAndZeroOutsideOfItsBox) {
  ForSeeds(3000, [](Random& random) {
    const Segment segment = RandomSegment(random, 3);
    const Eigen::AlignedBox3d box = Bounds(segment);
    Eigen::AlignedBox3d larger = box;
    larger.min() -= box.sizes();
    larger.max() += box.sizes();
    const Eigen::Vector3d point = random.InBox(larger);
    const FieldSample sample = Evaluate(segment, point);
    ASSERT_TRUE(std::isfinite(sample.value) && sample.gradient.allFinite());
    ASSERT_GE(sample.value, 0);
    if (!box.contains(point)) {
      ASSERT_EQ(sample.value, 0);
    }
  });
}

TEST(Segment, NoValueIsEverNotANumber) {
  const Segment segments[] = {
      {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1, 1},
      {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1, 2},
      {Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 0, 0), 1, 0},
      {Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 0, 0), 0, 1},
      {Eigen::Vector3d::Zero(), Eigen::Vector3d(1e-300, 0, 0), 1, 1},
      {Eigen::Vector3d::Zero(), Eigen::Vector3d(1e-9, 0, 0), 1, 1e-300},
      {Eigen::Vector3d::Zero(), Eigen::Vector3d(1e12, 0, 0), 1e-12, 1},
  };
  ForSeeds(200, [&](Random& random) {
    for (const Segment& segment : segments) {
      for (const Eigen::Vector3d& point :
           {segment.a, segment.b,
            Eigen::Vector3d(segment.b + random.LogUniform(1e-300, 1e6) * random.Direction()),
            Eigen::Vector3d(2 * segment.b)}) {
        const FieldSample sample = Evaluate(segment, point);
        ASSERT_TRUE(std::isfinite(sample.value) && sample.gradient.allFinite())
            << sample.value << " at " << point.transpose();
      }
    }
  });
}

TEST(Segment, ZeroLengthContributesNothing) {
  const Segment segment{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3), 1, 2};
  EXPECT_EQ(Evaluate(segment, {1, 2, 3}).value, 0);
  EXPECT_EQ(Evaluate(segment, {1, 2.5, 3}).gradient.norm(), 0);
  EXPECT_TRUE(Bounds(segment).isEmpty());
  EXPECT_TRUE(PreSplit(segment).empty());
}

TEST(Point, IsASphereOfItsRadiusAndItsGradientIsItsSlope) {
  const PointPrimitive point{Eigen::Vector3d(1, 2, 3), 0.5, 1};
  EXPECT_NEAR(Evaluate(point, {1.5, 2, 3}).value, 1, 1e-15);
  EXPECT_EQ(Evaluate(point, {1, 3, 3}).value, 0);
  ForSeeds(300, [](Random& random) {
    const PointPrimitive any{random.Direction(), random.LogUniform(0.5, 2), random.Uniform(0.5, 1)};
    const Eigen::Vector3d at =
        any.center + random.Uniform(0, 2.1) * any.radius * random.Direction();
    const FieldSample sample = Evaluate(any, at);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(i);
      const double difference =
          (Evaluate(any, at + step).value - Evaluate(any, at - step).value) / 2e-6;
      EXPECT_NEAR(sample.gradient[i], difference, 1e-8);
    }
  });
}

TEST(PreSplit, PiecesAreShortAndAddUpToTheSegment) {
  ForSeeds(1000, [](Random& random) {
    Segment segment = RandomSegment(random, 1.5);
    if (random.Chance(0.2)) (random.Chance(0.5) ? segment.radius_a : segment.radius_b) = 0;
    if (random.Chance(0.2)) segment.b += 200 * (segment.b - segment.a);
    const std::vector<Segment> pieces = PreSplit(segment);
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(pieces.front().a, segment.a);
    EXPECT_EQ(pieces.back().b, segment.b);
    EXPECT_EQ(pieces.front().radius_a, segment.radius_a);
    EXPECT_EQ(pieces.back().radius_b, segment.radius_b);
    const double largest = std::max(segment.radius_a, segment.radius_b);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (i > 0) {
        EXPECT_EQ(pieces[i].a, pieces[i - 1].b);
        EXPECT_EQ(pieces[i].radius_a, pieces[i - 1].radius_b);
      }
      const double large = std::max(pieces[i].radius_a, pieces[i].radius_b);
      const double small = std::min(pieces[i].radius_a, pieces[i].radius_b);
      if (small < kTipRadius * largest * (1 - 1e-9)) {
        EXPECT_LE(large, kTipRadius * largest * (1 + 1e-9));
        continue;
      }
      EXPECT_LE((pieces[i].b - pieces[i].a).norm(), kPieceLengthRadii * large * (1 + 1e-9));
      EXPECT_LE(large, kPieceRadiusRatio * small * (1 + 1e-9));
    }
    const Eigen::Vector3d point = PointNear(random, segment);
    double sum = 0;
    for (const Segment& piece : pieces) sum += Evaluate(piece, point).value;
    EXPECT_NEAR(sum, Evaluate(segment, point).value, 1e-9);
  });
}

}  // namespace
}  // namespace lascaux

#include "lascaux/sketch/bezier.h"

#include <gtest/gtest.h>

#include "support/cases.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::ForSeeds;
using testing::Random;

CubicBezier RandomCurve(Random& random) {
  const double size = random.LogUniform(1e-3, 1e3);
  CubicBezier curve;
  for (Vector2d& point : curve.p) {
    point = size * Vector2d(random.Uniform(-1, 1), random.Uniform(-1, 1));
  }
  return curve;
}

double SizeOf(const CubicBezier& curve) {
  double size = 0;
  for (const Vector2d& point : curve.p) size = std::max(size, point.norm());
  return size;
}

double DistanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double length2 = (b - a).squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
  return (p - a - t * (b - a)).norm();
}

TEST(Bezier, LinesHaveTheirHandlesAtTheThirds) {
  const CubicBezier line = Line({3, 6}, {9, -3});
  EXPECT_EQ(line.p[0], Vector2d(3, 6));
  EXPECT_LT((line.p[1] - Vector2d(5, 3)).norm(), 1e-14);
  EXPECT_LT((line.p[2] - Vector2d(7, 0)).norm(), 1e-14);
  EXPECT_EQ(line.p[3], Vector2d(9, -3));
  EXPECT_LT((line.At(0.25) - Vector2d(4.5, 3.75)).norm(), 1e-14);
  EXPECT_LT((line.Derivative(0.7) - Vector2d(6, -9)).norm(), 1e-13);
  EXPECT_LT(line.SecondDerivative(0.3).norm(), 1e-13);
}

TEST(Bezier, CurvesBeginAndEndExactlyAtTheirEnds) {
  ForSeeds(200, [](Random& random) {
    const CubicBezier curve = RandomCurve(random);
    EXPECT_EQ(curve.At(0), curve.p[0]);
    EXPECT_EQ(curve.At(1), curve.p[3]);
  });
}

TEST(Bezier, DerivativesAreTheLimitsOfDifferences) {
  ForSeeds(200, [](Random& random) {
    const CubicBezier curve = RandomCurve(random);
    const double t = random.Uniform(0.1, 0.9), h = 1e-4;
    const Vector2d first = (curve.At(t + h) - curve.At(t - h)) / (2 * h);
    const Vector2d second = (curve.Derivative(t + h) - curve.Derivative(t - h)) / (2 * h);
    EXPECT_LT((first - curve.Derivative(t)).norm(), 1e-6 * SizeOf(curve));
    EXPECT_LT((second - curve.SecondDerivative(t)).norm(), 1e-6 * SizeOf(curve));
  });
}

TEST(Bezier, SplittingGivesTheSameCurveInTwoPieces) {
  ForSeeds(200, [](Random& random) {
    const CubicBezier curve = RandomCurve(random);
    const double t = random.Uniform(0.01, 0.99), s = random.Uniform(0, 1);
    const auto [before, after] = Split(curve, t);
    EXPECT_EQ(before.p[0], curve.p[0]);
    EXPECT_EQ(before.p[3], after.p[0]);
    EXPECT_EQ(after.p[3], curve.p[3]);
    EXPECT_LT((before.At(s) - curve.At(s * t)).norm(), 1e-13 * SizeOf(curve));
    EXPECT_LT((after.At(s) - curve.At(t + s * (1 - t))).norm(), 1e-13 * SizeOf(curve));
  });
}

TEST(Bezier, ReversingTwiceChangesNothing) {
  ForSeeds(50, [](Random& random) {
    const CubicBezier curve = RandomCurve(random);
    const double t = random.Uniform(0, 1);
    EXPECT_EQ(Reversed(Reversed(curve)), curve);
    EXPECT_LT((Reversed(curve).At(t) - curve.At(1 - t)).norm(), 1e-13 * SizeOf(curve));
    EXPECT_LT((Reversed(curve).StartTangent() + curve.EndTangent()).norm(), 1e-15);
  });
}

TEST(Bezier, BoundsHoldTheCurveAndTouchItOnEachSide) {
  ForSeeds(500, [](Random& random) {
    const CubicBezier curve = RandomCurve(random);
    const Eigen::AlignedBox2d box = Bounds(curve);
    Eigen::AlignedBox2d sampled;
    for (int i = 0; i <= 2000; ++i) sampled.extend(curve.At(i / 2000.0));
    const double rounding = 1e-12 * SizeOf(curve), between = 1e-5 * SizeOf(curve);
    EXPECT_LE((box.min() - sampled.min()).maxCoeff(), rounding);
    EXPECT_LE((sampled.max() - box.max()).maxCoeff(), rounding);
    EXPECT_LE((sampled.min() - box.min()).maxCoeff(), between);
    EXPECT_LE((box.max() - sampled.max()).maxCoeff(), between);
  });
}

TEST(Bezier, BoundsOfAnArchAreThoseOfItsCrownNotOfItsHandles) {
  const CubicBezier arch{{Vector2d(0, 0), Vector2d(0, 4), Vector2d(3, 4), Vector2d(3, 0)}};
  EXPECT_EQ(Bounds(arch).min(), Vector2d(0, 0));
  EXPECT_LT((Bounds(arch).max() - Vector2d(3, 3)).norm(), 1e-15);
}

TEST(Bezier, FlattenedCurvesStayWithinTheTolerance) {
  ForSeeds(200, [](Random& random) {
    const CubicBezier curve = RandomCurve(random);
    const double tolerance = SizeOf(curve) * random.LogUniform(1e-5, 1e-1);
    const std::vector<CurveSample> samples = Flatten(curve, tolerance);
    ASSERT_GE(samples.size(), 2u);
    EXPECT_EQ(samples.front().point, curve.p[0]);
    EXPECT_EQ(samples.back().point, curve.p[3]);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      ASSERT_LT(samples[i].t, samples[i + 1].t);
      for (const double s : {0.25, 0.5, 0.75}) {
        const Vector2d on_curve = curve.At(samples[i].t + s * (samples[i + 1].t - samples[i].t));
        ASSERT_LE(DistanceToSegment(on_curve, samples[i].point, samples[i + 1].point),
                  tolerance * (1 + 1e-9));
      }
    }
  });
}

TEST(Bezier, FlatteningALineTakesTwoSamplesAndNoCurveMoreThan4096) {
  EXPECT_EQ(Flatten(Line({0, 0}, {100, 50}), 1e-3).size(), 2u);
  const CubicBezier wild{{Vector2d(0, 0), Vector2d(1e9, 0), Vector2d(-1e9, 0), Vector2d(0, 1)}};
  EXPECT_EQ(Flatten(wild, 1e-6).size(), 4096u);
}

TEST(Bezier, TangentsFallBackToLaterControlPoints) {
  const Vector2d o(1, 1), a(1, 3), b(4, 5);
  EXPECT_EQ((CubicBezier{{o, o, a, b}}.StartTangent()), Vector2d(0, 1));
  EXPECT_EQ((CubicBezier{{o, o, o, a}}.StartTangent()), Vector2d(0, 1));
  EXPECT_EQ((CubicBezier{{b, o, a, a}}.EndTangent()), Vector2d(0, 1));
  EXPECT_EQ((CubicBezier{{o, a, a, a}}.EndTangent()), Vector2d(0, 1));
  EXPECT_EQ((CubicBezier{{o, o, o, o}}.StartTangent()), Vector2d(0, 0));
  EXPECT_EQ((CubicBezier{{o, o, o, o}}.EndTangent()), Vector2d(0, 0));
}

}  // namespace
}  // namespace lascaux

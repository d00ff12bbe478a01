#include "lascaux/field/field.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;
using testing::RandomCreature;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

FieldPart Cylinder(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius) {
  FieldPart part;
  part.chains.push_back({{{a, b, radius, radius}}, {}});
  return part;
}

TEST(Ricci, WithExponentOneIsTheSumAndWithALargeOneTheMaximum) {
  const std::array<FieldSample, 2> samples = {FieldSample{0.5, {1, 0, 0}},
                                              FieldSample{0.25, {0, 2, 0}}};
  const FieldSample sum = BlendRicci(samples, 1);
  EXPECT_DOUBLE_EQ(sum.value, 0.75);
  EXPECT_LE((sum.gradient - Eigen::Vector3d(1, 2, 0)).norm(), 1e-15);
  const FieldSample maximum = BlendRicci(samples, 64);
  EXPECT_NEAR(maximum.value, 0.5, 1e-15);
  EXPECT_LE((maximum.gradient - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
}

TEST(Ricci, IsTheRootOfTheSumOfPowersForIntegerAndOtherExponents) {
  ForSeeds(200, [](Random& random) {
    std::array<FieldSample, 3> samples;
    for (FieldSample& sample : samples) sample = {random.LogUniform(1e-3, 5), random.Direction()};
    for (double n : {1.0, 1.5, 2.0, 3.0, 4.0, 5.7, 8.0, 16.0}) {
      const FieldSample blend = BlendRicci(samples, n);
      double sum = 0;
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      for (const FieldSample& sample : samples) sum += std::pow(sample.value, n);
      const double value = std::pow(sum, 1 / n);
      for (const FieldSample& sample : samples) {
        gradient += std::pow(sample.value / value, n - 1) * sample.gradient;
      }
      EXPECT_NEAR(blend.value, value, 1e-13 * value);
      EXPECT_LE((blend.gradient - gradient).norm(), 1e-13);
    }
  });
}

TEST(Ricci, NeitherOverflowsNorUnderflows) {
  for (double scale : {1e-300, 1e-30, 1e30, 1e300}) {
    const std::array<FieldSample, 2> samples = {FieldSample{scale, {1, 0, 0}},
                                                FieldSample{scale, {1, 0, 0}}};
    EXPECT_NEAR(BlendRicci(samples, 8).value / scale, std::pow(2, 1.0 / 8), 1e-14);
  }
  EXPECT_EQ(BlendRicci(std::array<FieldSample, 2>{}, 4).value, 0);
}

TEST(Field, OnlyAPartAndItsParentBlend) {
  Field field;
  field.parts = {Cylinder({-9, 0, 0}, {9, 0, 0}, 1), Cylinder({-9, 1.5, 0}, {9, 1.5, 0}, 1),
                 Cylinder({-9, -1.5, 0}, {9, -1.5, 0}, 1)};
  field.parts[1].parent = 0;
  field.parts[2].parent = 0;
  const Eigen::Vector3d point(0, 0, 0);
  const FieldSample body = EvaluatePart(field, 0, point), limb = EvaluatePart(field, 1, point);
  EXPECT_NEAR(Evaluate(field, point).value, BlendRicci(std::array{body, limb}, 4).value, 1e-15);
  field.parts[1].parent.reset();
  field.parts[2].parent.reset();
  EXPECT_EQ(Evaluate(field, point).value, body.value);
}

TEST(Field, DepthScaleFlattensAPartAboutItsOwnPlane) {
  Field field;
  field.parts = {Cylinder({-9, 0, 3}, {9, 0, 3}, 2)};
  field.parts[0].z0 = 3;
  field.parts[0].depth_scale = 0.5;
  EXPECT_NEAR(Evaluate(field, {0, 2, 3}).value, 1, 1e-14);
  const FieldSample top = Evaluate(field, {0, 0, 4});
  EXPECT_NEAR(top.value, 1, 1e-14);
  EXPECT_NEAR(top.gradient.z(), -7.0 / 3, 1e-13);
  EXPECT_DOUBLE_EQ(Bounds(field).max().z(), 5);
  EXPECT_DOUBLE_EQ(Bounds(field).max().y(), 4);
}

TEST(Field, GradientIsTheDerivativeOfTheValue) {
  ForSeeds(200, [](Random& random) {
    const Field field = RandomCreature(random);
    const Eigen::AlignedBox3d box = Bounds(field);
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d point = random.InBox(box);
      const FieldSample sample = Evaluate(field, point);
      for (int i = 0; i < 3; ++i) {
        // The maximum over parts has creases: a kink shows as two one-sided differences that
        // differ.
        const double step = 1e-6;
        const double ahead =
            (Evaluate(field, point + step * Eigen::Vector3d::Unit(i)).value - sample.value) / step;
        const double back =
            (sample.value - Evaluate(field, point - step * Eigen::Vector3d::Unit(i)).value) / step;
        if (std::abs(ahead - back) > 1e-3) continue;
        ASSERT_NEAR(sample.gradient[i], (ahead + back) / 2, 1e-6) << sample.value;
      }
    }
  });
}

TEST(Field, IsZeroOutsideOfItsBounds) {
  ForSeeds(200, [](Random& random) {
    const Field field = RandomCreature(random);
    const Eigen::AlignedBox3d box = Bounds(field);
    Eigen::AlignedBox3d larger = box;
    larger.min().array() -= 3;
    larger.max().array() += 3;
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector3d point = random.InBox(larger);
      if (box.contains(point)) continue;
      ASSERT_EQ(Evaluate(field, point).value, 0);
    }
  });
  EXPECT_TRUE(Bounds(Field{}).isEmpty());
  EXPECT_EQ(Evaluate(Field{}, {0, 0, 0}).value, 0);
}

TEST(SignedDistance, IsExactForCylinders) {
  Field field;
  field.parts = {Cylinder({-90, 0, 0}, {90, 0, 0}, 2)};
  for (double r = 0.51; r < 3.9; r += 0.1) {
    EXPECT_NEAR(SignedDistance(Evaluate(field, {1, r, 0})), r - 2, 1e-8) << r;
  }
  for (double r = 0.05; r < 0.5; r += 0.1) {
    EXPECT_LE(SignedDistance(Evaluate(field, {1, r, 0})), r - 2) << r;
  }
}

TEST(SignedDistance, HasASignAndNoNaNWhereverTheFieldSaturates) {
  EXPECT_EQ(SignedDistance({0, {0, 0, 0}}), kInfinity);
  EXPECT_EQ(SignedDistance({0.5, {0, 0, 0}}), kInfinity);
  EXPECT_EQ(SignedDistance({2, {0, 0, 0}}), -kInfinity);
  EXPECT_EQ(SignedDistance({50, {1, 0, 0}}), -kInfinity);
  EXPECT_EQ(SignedDistance({1, {1, 0, 0}}), 0);
  EXPECT_EQ(SignedDistance({1, {0, 0, 0}}), 0);
}

TEST(Validate, FindsNothingInRandomCreatures) {
  ForSeeds(50, [](Random& random) { EXPECT_EQ(Validate(RandomCreature(random)), Diagnostics{}); });
}

TEST(Validate, AllowsSegmentsOfLengthZeroAndTips) {
  Field field;
  field.parts = {Cylinder({1, 1, 1}, {1, 1, 1}, 1), Cylinder({1, 1, 1}, {2, 1, 1}, 1)};
  field.parts[1].chains[0].segments[0].radius_b = 0;
  EXPECT_EQ(Validate(field), Diagnostics{});
}

TEST(Validate, ReportsABadPrimitiveForEachThingThatNoFieldIsMadeOf) {
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  Field good;
  good.parts = {Cylinder({0, 0, 0}, {1, 0, 0}, 1), Cylinder({0, 1, 0}, {1, 1, 0}, 1)};
  good.parts[1].chains[0].points.push_back({{0, 0, 0}, 1, 1});
  const auto segment = [](Field& f) -> Segment& { return f.parts[1].chains[0].segments[0]; };
  const auto point = [](Field& f) -> PointPrimitive& { return f.parts[1].chains[0].points[0]; };
  const std::function<void(Field&)> harms[] = {
      [&](Field& f) { segment(f).radius_a = -1; },
      [&](Field& f) { segment(f).radius_b = kNaN; },
      [&](Field& f) { segment(f).radius_b = kInfinity; },
      [&](Field& f) { segment(f).radius_a = segment(f).radius_b = 0; },
      [&](Field& f) { segment(f).a.x() = kNaN; },
      [&](Field& f) { segment(f).b.z() = kInfinity; },
      [&](Field& f) { point(f).radius = 0; },
      [&](Field& f) { point(f).radius = -2; },
      [&](Field& f) { point(f).weight = -1; },
      [&](Field& f) { point(f).weight = kNaN; },
      [&](Field& f) { point(f).center.y() = kNaN; },
      [&](Field& f) { f.parts[1].z0 = kNaN; },
      [&](Field& f) { f.parts[1].depth_scale = 0; },
      [&](Field& f) { f.parts[1].depth.emplace(); },
      [&](Field& f) {
        f.parts[1].depth = DepthMap{{0, 0}, 1, 1, 2, {0, 0}, {1}};
      },
      [&](Field& f) {
        f.parts[1].depth = DepthMap{{0, 0}, 0, 1, 1, {0}, {1}};
      },
      [&](Field& f) {
        f.parts[1].depth = DepthMap{{0, 0}, 1, 1, 1, {NAN}, {1}};
      },
      [&](Field& f) {
        f.parts[1].depth = DepthMap{{0, 0}, 1, 1, 1, {0}, {0}};
      },
      [&](Field& f) { f.parts[1].parent = 1; },
      [&](Field& f) { f.parts[1].parent = -1; },
  };
  for (std::size_t i = 0; i < std::size(harms); ++i) {
    Field field = good;
    harms[i](field);
    const Diagnostics found = Validate(field);
    ASSERT_EQ(found.size(), 1u) << "harm " << i;
    EXPECT_EQ(found[0].code, "bad-primitive");
    EXPECT_EQ(found[0].severity, Severity::kError);
    EXPECT_NE(found[0].message.find("part 1"), std::string::npos) << found[0].message;
  }
  for (double exponent : {0.5, 65.0, kNaN}) {
    Field field = good;
    field.part_exponent = exponent;
    ASSERT_EQ(Validate(field).size(), 1u);
    EXPECT_EQ(Validate(field)[0].code, "bad-primitive");
  }
  for (const PlanarGain& gain :
       {PlanarGain{}, PlanarGain{{0, 0}, 1, 1, 1, {NAN}}, PlanarGain{{0, 0}, 1, 1, 1, {33}},
        PlanarGain{{0, 0}, 1, 2, 1, {0}}, PlanarGain{{kNaN, 0}, 1, 1, 1, {0}}}) {
    Field field = good;
    field.gain = gain;
    ASSERT_EQ(Validate(field).size(), 1u);
    EXPECT_NE(Validate(field)[0].message.find("gain"), std::string::npos);
  }
}

}  // namespace
}  // namespace lascaux

#include "lascaux/field/compiled_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;
using testing::RandomCreature;

std::vector<Isa> SupportedIsas() {
  std::vector<Isa> isas;
  for (Isa isa : {Isa::kBaseline, Isa::kAvx2, Isa::kAvx512}) {
    if (IsSupported(isa)) isas.push_back(isa);
  }
  return isas;
}

/// Points of a block, and room for what is found there.
struct Block {
  Eigen::Vector3d origin;
  std::vector<float> x, y, z, value, gx, gy, gz;

  Block(Random& random, const Eigen::AlignedBox3d& box, int count) : origin(random.InBox(box)) {
    const double reach = 0.1 * box.sizes().maxCoeff();
    for (int i = 0; i < count; ++i) {
      x.push_back(static_cast<float>(random.Uniform(-reach, reach)));
      y.push_back(static_cast<float>(random.Uniform(-reach, reach)));
      z.push_back(static_cast<float>(random.Uniform(-reach, reach)));
    }
    for (std::vector<float>* column : {&value, &gx, &gy, &gz}) column->resize(x.size());
  }
  Eigen::Vector3d Point(std::size_t i) const { return origin + Eigen::Vector3d(x[i], y[i], z[i]); }
  PointBlock points() const { return {origin, x, y, z}; }
  SampleBlock samples() { return {value, gx, gy, gz}; }
  Eigen::Vector3d Gradient(std::size_t i) const { return {gx[i], gy[i], gz[i]}; }
};

/// True when two branches of the maximum are nearly equal at the point.
bool NearCrease(const Field& field, const Eigen::Vector3d& point) {
  std::vector<double> branches;
  for (std::size_t i = 0; i < field.parts.size(); ++i) {
    const FieldSample own = EvaluatePart(field, static_cast<int>(i), point);
    const std::optional<int> parent = field.parts[i].parent;
    branches.push_back(parent ? BlendRicci(std::array{own, EvaluatePart(field, *parent, point)},
                                           field.part_exponent)
                                    .value
                              : own.value);
  }
  std::sort(branches.rbegin(), branches.rend());
  return branches.size() > 1 && branches[0] - branches[1] < 4 * kFloatValueError * branches[0];
}

TEST(CompiledField, AgreesWithDoublePrecisionForEveryInstructionSet) {
  for (Isa isa : SupportedIsas()) {
    SCOPED_TRACE(Name(isa));
    double worst_value = 0, worst_gradient = 0;
    ForSeeds(100, [&](Random& random) {
      const Field field = RandomCreature(random);
      const CompiledField compiled(field, isa);
      Block block(random, compiled.bounds(), 300);
      const double thinnest = compiled.ThinnestRadius(compiled.All());
      compiled.EvaluateSamples(block.points(), compiled.All(), block.samples());
      std::vector<float> values(block.x.size());
      compiled.EvaluateValues(block.points(), compiled.All(), values);
      for (std::size_t i = 0; i < block.x.size(); ++i) {
        const FieldSample exact = Evaluate(field, block.Point(i));
        const double scale = std::max(1.0, exact.value / 4);
        const double error = std::abs(block.value[i] - exact.value) / scale;
        ASSERT_LE(error, kFloatValueError) << exact.value;
        ASSERT_LE(std::abs(values[i] - exact.value) / scale, kFloatValueError);
        worst_value = std::max(worst_value, error);
        // At a crease of the maximum the two may take different sides.
        if (NearCrease(field, block.Point(i))) continue;
        const double gradient_error =
            (block.Gradient(i) - exact.gradient).norm() * thinnest / scale;
        ASSERT_LE(gradient_error, kFloatGradientError) << exact.gradient.transpose();
        worst_gradient = std::max(worst_gradient, gradient_error);
      }
    });
    RecordProperty(std::string("value_error_") + Name(isa), std::to_string(worst_value));
    RecordProperty(std::string("gradient_error_") + Name(isa), std::to_string(worst_gradient));
  }
}

TEST(CompiledField, HoldsItsErrorOnLongSteepAndThinSegments) {
  ForSeeds(300, [](Random& random) {
    Segment segment = testing::RandomSegment(random);
    if (random.Chance(0.3)) segment.b += 100 * (segment.b - segment.a);
    if (random.Chance(0.3)) segment.radius_b = random.Chance(0.5) ? 0 : 1e-3 * segment.radius_a;
    Field field;
    field.parts.emplace_back();
    field.parts[0].chains.push_back({{segment}, {}});
    const double scale = random.LogUniform(1e-6, 1e6);
    for (Segment& s : field.parts[0].chains[0].segments) {
      s = {scale * s.a, scale * s.b, scale * s.radius_a, scale * s.radius_b};
    }
    const Segment& scaled = field.parts[0].chains[0].segments[0];
    const CompiledField compiled(field);
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector3d point = testing::PointNear(random, scaled);
      const double large = std::max(scaled.radius_a, scaled.radius_b);
      if ((point - scaled.b).norm() < 2.1 * kTipRadius * large) continue;
      const float zero = 0;
      float value = -1;
      compiled.EvaluateValues({point, {&zero, 1}, {&zero, 1}, {&zero, 1}}, compiled.All(),
                              {&value, 1});
      const double exact = Evaluate(field, point).value;
      ASSERT_NEAR(value, exact, kFloatValueError * std::max(1.0, exact / 4))
          << "slope " << (scaled.radius_b - scaled.radius_a) / (scaled.b - scaled.a).norm();
    }
  });
}

TEST(CompiledField, BlendsWithEveryExponent) {
  ForSeeds(40, [](Random& random) {
    Field field = RandomCreature(random);
    for (double exponent : {1.0, 1.7, 2.0, 3.0, 4.0, 6.0, 8.0, 16.0, 64.0}) {
      field.chain_exponent = field.part_exponent = exponent;
      const CompiledField compiled(field);
      Block block(random, compiled.bounds(), 40);
      compiled.EvaluateSamples(block.points(), compiled.All(), block.samples());
      for (std::size_t i = 0; i < block.x.size(); ++i) {
        const double exact = Evaluate(field, block.Point(i)).value;
        ASSERT_NEAR(block.value[i], exact, kFloatValueError * std::max(1.0, exact / 4)) << exponent;
      }
    }
  });
}

/// Somewhere on the surface.
Eigen::Vector3d OnSurface(Random& random, const Field& field, const Eigen::AlignedBox3d& box) {
  Eigen::Vector3d inside = random.InBox(box), outside = box.max();
  for (int i = 0; i < 1000 && !(Evaluate(field, inside).value > 1); ++i) inside = random.InBox(box);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d middle = (inside + outside) / 2;
    (Evaluate(field, middle).value > 1 ? inside : outside) = middle;
  }
  return inside;
}

TEST(CompiledField, InterpolatedLatticesHaveTheSignsOfValues) {
  const auto isas = SupportedIsas();
  ForSeeds(300, [&](Random& random) {
    const Field field = RandomCreature(random);
    const CompiledField compiled(field, isas[random.Integer(0, static_cast<int>(isas.size()) - 1)]);
    const double thinnest = compiled.ThinnestRadius(compiled.All());
    for (int k = 0; k < 8; ++k) {
      const double step = random.LogUniform(0.03, 1) * thinnest;
      const LatticeBlock lattice{OnSurface(random, field, compiled.bounds()), step};
      std::array<float, 512> x, y, z, values;
      const auto offset = [step](std::size_t i) {
        return static_cast<float>(step * (static_cast<double>(i) - 3.5));
      };
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = offset(i / 64);
        y[i] = offset(i / 8 % 8);
        z[i] = offset(i % 8);
      }
      compiled.EvaluateValues({lattice.center, x, y, z}, compiled.All(), values);
      const LatticeBits inside = compiled.FindInside(lattice, compiled.All());
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_EQ(inside[i / 64] >> i % 64 & 1, values[i] > 1 ? 1 : 0)
            << i << ": " << values[i] << ", thinnest " << thinnest / step << " steps";
      }
    }
  });
}

TEST(CompiledField, PointsAreIndependentOfTheirBlock) {
  ForSeeds(30, [](Random& random) {
    const CompiledField compiled(RandomCreature(random));
    Block block(random, compiled.bounds(), 333);
    compiled.EvaluateSamples(block.points(), compiled.All(), block.samples());
    for (std::size_t begin = 0; begin < block.x.size(); begin += begin % 7 + 1) {
      const std::size_t count = std::min<std::size_t>(begin % 3 + 1, block.x.size() - begin);
      const auto part = [&](const std::vector<float>& v) {
        return std::span(v).subspan(begin, count);
      };
      std::vector<float> f(count), gx(count), gy(count), gz(count);
      compiled.EvaluateSamples({block.origin, part(block.x), part(block.y), part(block.z)},
                               compiled.All(), {f, gx, gy, gz});
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_EQ(f[k], block.value[begin + k]);
        ASSERT_EQ(gy[k], block.gy[begin + k]);
      }
    }
  });
}

TEST(CompiledField, IsFiniteInThePlaneOfAnApex) {
  // The place y where a kernel peaks is at infinity there; the field is 0.
  Field field;
  field.parts.emplace_back();
  field.parts[0].chains.push_back(
      {{{Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 0, 0), 1, 0.5}}, {}});
  const std::vector<float> x(64, 2.f), y(64, 1.f);
  std::vector<float> z(64), f(64), gx(64), gy(64), gz(64);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = static_cast<float>(i) / 16;
  for (Isa isa : SupportedIsas()) {
    const CompiledField compiled(field, isa);
    compiled.EvaluateSamples({Eigen::Vector3d::Zero(), x, y, z}, compiled.All(), {f, gx, gy, gz});
    for (std::size_t i = 0; i < z.size(); ++i) {
      EXPECT_EQ(f[i], Evaluate(field, {2, 1, z[i]}).value);
      EXPECT_EQ(gx[i], 0);
    }
  }
}

TEST(CompiledField, MirroredFieldHasTheSameBitsAtMirroredPoints) {
  ForSeeds(20, [](Random& random) {
    const Field field = RandomCreature(random);
    Field mirrored = field;
    for (FieldPart& part : mirrored.parts) {
      part.z0 = -part.z0;
      for (FieldChain& chain : part.chains) {
        for (Segment& s : chain.segments) s.a.z() *= -1, s.b.z() *= -1;
        for (PointPrimitive& p : chain.points) p.center.z() *= -1;
      }
    }
    const CompiledField compiled(field), other(mirrored);
    Block block(random, compiled.bounds(), 200);
    compiled.EvaluateSamples(block.points(), compiled.All(), block.samples());
    Block there = block;
    there.origin.z() *= -1;
    for (float& z : there.z) z = -z;
    other.EvaluateSamples(there.points(), other.All(), there.samples());
    EXPECT_EQ(there.value, block.value);
    EXPECT_EQ(there.gx, block.gx);
    for (float& gz : there.gz) gz = -gz;
    EXPECT_EQ(there.gz, block.gz);
  });
}

TEST(CompiledField, IsZeroWithoutPrimitives) {
  const CompiledField empty{Field{}};
  EXPECT_TRUE(empty.bounds().isEmpty());
  EXPECT_TRUE(empty.All().primitives.empty());
  EXPECT_EQ(empty.ThinnestRadius(empty.All()), std::numeric_limits<double>::infinity());
  const float zero = 0;
  float value = -1;
  empty.EvaluateValues({{1, 2, 3}, {&zero, 1}, {&zero, 1}, {&zero, 1}}, empty.All(), {&value, 1});
  EXPECT_EQ(value, 0);
  EXPECT_EQ(empty.BoundOnBall({{0, 0, 0}, 1}, empty.All()).bounds, (FieldBounds{0, 0}));
  empty.EvaluateValues({}, empty.All(), {});
}

TEST(CompiledField, StaysFiniteFarAwayAndOnEveryVertex) {
  ForSeeds(30, [](Random& random) {
    const Field field = RandomCreature(random);
    std::vector<Eigen::Vector3d> places = {{1e6, 0, 0}, {0, -1e9, 3}, {1e5, 1e5, 1e5}};
    for (const FieldPart& part : field.parts) {
      for (const Segment& s : part.chains[0].segments) places.push_back(s.a), places.push_back(s.b);
    }
    for (Isa isa : SupportedIsas()) {
      const CompiledField compiled(field, isa);
      for (const Eigen::Vector3d& place : places) {
        const float zero = 0;
        float f = NAN, gx = NAN, gy = NAN, gz = NAN;
        compiled.EvaluateSamples({place, {&zero, 1}, {&zero, 1}, {&zero, 1}}, compiled.All(),
                                 {{&f, 1}, {&gx, 1}, {&gy, 1}, {&gz, 1}});
        ASSERT_TRUE(std::isfinite(f) && std::isfinite(gx + gy + gz)) << place.transpose();
        const double exact = Evaluate(field, place).value;
        ASSERT_NEAR(f, exact, kFloatValueError * std::max(1.0, exact / 4));
      }
    }
  });
}

TEST(CompiledField, DistancesAgreeWithDoublePrecision) {
  for (Isa isa : SupportedIsas()) {
    ForSeeds(100, [&](Random& random) {
      std::vector<float> f(200), gx(200), gy(200), gz(200), d(200);
      for (std::size_t i = 0; i < f.size(); ++i) {
        f[i] = static_cast<float>(random.LogUniform(1e-6, 2.7));
        const Eigen::Vector3d g = random.LogUniform(0.1, 3) * random.Direction();
        gx[i] = static_cast<float>(g.x()), gy[i] = static_cast<float>(g.y()),
        gz[i] = static_cast<float>(g.z());
      }
      f[0] = 0;
      f[1] = 3;
      const float limit = 0.4f;
      SignedDistances({f, gx, gy, gz}, limit, d, isa);
      for (std::size_t i = 0; i < f.size(); ++i) {
        const Eigen::Vector3d g(gx[i], gy[i], gz[i]);
        const double exact = SignedDistance({f[i], g});
        const double psi_slope =
            g.norm() / (7.0 / 3 * 0.25 * std::pow(std::max<double>(f[i], 1e-9), 5.0 / 7));
        ASSERT_NEAR(d[i], std::clamp<double>(exact, -limit, limit), 1e-5 / std::min(psi_slope, 1.0))
            << f[i];
      }
      EXPECT_EQ(d[0], limit);
      EXPECT_EQ(d[1], -limit);
    });
  }
}

}  // namespace
}  // namespace lascaux

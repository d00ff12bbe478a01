#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lascaux/field/compiled_field.h"
#include "lascaux/field/field.h"
#include "lascaux/skeleton/creature.h"
#include "lascaux/skeleton/fit.h"
#include "lascaux/skeleton/normalise_outline.h"
#include "lascaux/volume/narrow_band.h"
#include "skeleton/index.h"
#include "skeleton/shapes.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::ForSeeds;
using testing::Random;

Creature Assembled(const testing::Drawing& drawing) {
  const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  EXPECT_TRUE(skeletons.ok());
  return AssembleCreature(drawing.graph, *skeletons);
}

/// A disc of the part's chains or of its axis.
SkeletonVertex& AnyDisc(Random& random, CreaturePart& part) {
  std::vector<Chain>& chains = random.Chance(0.5) ? part.chains : part.axis;
  Chain& chain = chains[Index(random.Integer(0, static_cast<int>(chains.size()) - 1))];
  return chain.vertices[Index(random.Integer(0, static_cast<int>(chain.vertices.size()) - 1))];
}

TEST(BadCreature, DiscsThatAreNoDiscsAreRefusedByTheNameOfTheirPart) {
  const testing::Drawing drawing = testing::MakeBeast();
  const Creature good = Assembled(drawing);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ForSeeds(200, [&](Random& random) {
    Creature bad = good;
    CreaturePart& part =
        bad.parts[Index(random.Integer(0, static_cast<int>(bad.parts.size()) - 1))];
    SkeletonVertex& disc = AnyDisc(random, part);
    switch (random.Integer(0, 7)) {
      case 0:
        disc.radius = 0;
        break;
      case 1:
        disc.radius = -random.LogUniform(1e-12, 1e12);
        break;
      case 2:
        disc.radius = random.Chance(0.5) ? kNaN : kInfinity;
        break;
      case 3:
        disc.position.x() = random.Chance(0.5) ? kNaN : -kInfinity;
        break;
      case 4:
        disc.position.y() = random.Chance(0.5) ? kNaN : kInfinity;
        break;
      case 5:
        part.chains.clear();
        break;
      case 6:
        part.chains[0].vertices.clear();
        break;
      default:
        part.parent = static_cast<int>(&part - bad.parts.data()) + random.Integer(0, 3);
    }
    const std::string name = "part " + std::to_string(part.part);
    for (const auto& outcome :
         {FitToDrawing(drawing.parts, bad), PlaceInDepth(drawing.parts, drawing.graph, bad)}) {
      ASSERT_FALSE(outcome.ok());
      const Diagnostic& found = outcome.diagnostics().front();
      ASSERT_EQ(found.code, "bad-primitive");
      ASSERT_EQ(found.message.rfind(name, 0), 0u) << found.message;
    }
  });
  Creature stranger = good;
  stranger.parts[1].part = 99;
  EXPECT_FALSE(FitToDrawing(drawing.parts, stranger).ok());
}

/// Makes skeletons short or lets discs coincide.
void Degrade(Random& random, CreaturePart& part) {
  for (std::vector<Chain>* chains : {&part.chains, &part.axis}) {
    for (Chain& chain : *chains) {
      const SkeletonVertex first = chain.vertices.front();
      const double shrink = random.Chance(0.3) ? 0 : random.LogUniform(1e-9, 1);
      for (SkeletonVertex& v : chain.vertices) {
        v.position = first.position + shrink * (v.position - first.position);
        if (random.Chance(0.2)) v.radius *= random.LogUniform(1e-6, 3);
        if (random.Chance(0.1)) v.position = first.position;
      }
      if (random.Chance(0.2)) chain.vertices.resize(1);
    }
    if (random.Chance(0.3)) chains->push_back(chains->front());
  }
}

void ExpectFinite(const Field& field, Random& random) {
  ASSERT_EQ(Validate(field), Diagnostics{});
  const Eigen::AlignedBox3d box = Bounds(field);
  std::vector<Vector3d> points;
  for (const FieldPart& part : field.parts) {
    for (const FieldChain& chain : part.chains) {
      for (const Segment& s : chain.segments) points.push_back(s.a);
      for (const PointPrimitive& p : chain.points) points.push_back(p.center);
    }
  }
  for (int i = 0; i < 100; ++i) points.push_back(random.InBox(box));
  const Vector3d origin = box.center();
  std::vector<float> x, y, z;
  for (const Vector3d& p : points) {
    const FieldSample sample = Evaluate(field, p);
    ASSERT_TRUE(std::isfinite(sample.value) && sample.gradient.allFinite()) << p.transpose();
    ASSERT_FALSE(std::isnan(SignedDistance(sample))) << p.transpose();
    const Eigen::Vector3f offset = (p - origin).cast<float>();
    x.push_back(offset.x()), y.push_back(offset.y()), z.push_back(offset.z());
  }
  const CompiledField compiled(field);
  const BallBounds found =
      compiled.BoundOnBall({origin, box.diagonal().norm() / 2}, compiled.All());
  ASSERT_TRUE(std::isfinite(found.bounds.lower) && std::isfinite(found.bounds.upper));
  std::vector<float> value(x.size()), gx(x.size()), gy(x.size()), gz(x.size()), d(x.size());
  const SampleBlock samples{value, gx, gy, gz};
  compiled.EvaluateSamples({origin, x, y, z}, found.active, samples);
  SignedDistances(samples, 1, d);
  for (const std::vector<float>* column : {&value, &gx, &gy, &gz, &d}) {
    ASSERT_TRUE(
        std::all_of(column->begin(), column->end(), [](float f) { return std::isfinite(f); }));
  }
}

/// A coarse level set: an outcome, and never a value that is not a number.
void ExpectFiniteBand(const Field& field) {
  const auto band = RasteriseBand(field, {.voxel_size = Bounds(field).diagonal().norm() / 40});
  if (!band.ok()) {
    ASSERT_EQ(band.diagnostics().front().code, "empty-field");
    return;
  }
  ASSERT_FALSE(band->values.empty());
  for (const float value : band->values) ASSERT_TRUE(std::abs(value) <= band->background);
}

TEST(BadCreature, ShortSkeletonsAndCoincidentDiscsMakeFieldsOfNumbers) {
  const testing::Drawing drawing = testing::MakeBeast();
  const Creature good = Assembled(drawing);
  const ModelFrame frame = FrameOf(drawing.parts, drawing.graph, 100);
  ForSeeds(60, [&](Random& random) {
    Creature odd = good;
    for (CreaturePart& part : odd.parts) Degrade(random, part);
    FitOptions options;
    options.max_steps = 4;
    const auto fitted = FitToDrawing(drawing.parts, odd, options);
    ASSERT_TRUE(fitted.ok());
    for (const Creature& creature : {odd, *fitted}) {
      const auto placed = PlaceInDepth(drawing.parts, drawing.graph, creature);
      ASSERT_TRUE(placed.ok());
      const Field field = MakeField(*placed, frame);
      ExpectFinite(field, random);
      const Field normalised = NormaliseOutline(field, {drawing.parts, drawing.graph, frame});
      ExpectFinite(normalised, random);
      ExpectFiniteBand(normalised);
    }
  });
}

TEST(BadCreature, ASkeletonThatIsShorterThanItsRadiusStillHasASurface) {
  for (const double length : {0.0, 1e-9, 1e-3, 0.3, 0.9}) {
    testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 2, 2));
    Creature creature;
    creature.parts.push_back({});
    creature.parts[0].chains = {{{{{0, 0}, 2}, {{2 * length, 0}, 2}}}};
    const Field field = MakeField(creature, {});
    for (const Vector3d& side : {Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(-1, 0, 0)}) {
      EXPECT_GT(Evaluate(field, 0.93 * 2 * side).value, 1) << length;
      EXPECT_LT(Evaluate(field, 1.07 * 2 * side).value, 1) << length;
    }
    EXPECT_TRUE(FitToDrawing(drawing.parts, creature).ok());
  }
}

TEST(BadCreature, AnOutlineWithoutSizeLeavesTheDiscsAsTheyAre) {
  testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 2, 1));
  const Creature creature = Assembled(drawing);
  for (Vector2d& point : drawing.parts.parts[0].outline.points) point = {1, 1};
  EXPECT_EQ(*FitToDrawing(drawing.parts, creature), creature);
  EXPECT_EQ(MeasureFit(drawing.parts, creature)[0], FitError{});
}

}  // namespace
}  // namespace lascaux

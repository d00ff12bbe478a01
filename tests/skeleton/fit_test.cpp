#include "lascaux/skeleton/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lascaux/field/field.h"
#include "skeleton/chains.h"
#include "skeleton/index.h"
#include "skeleton/planar_field.h"
#include "skeleton/ring.h"
#include "skeleton/shapes.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

Creature Placed(const testing::Drawing& drawing) {
  const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  EXPECT_TRUE(skeletons.ok());
  return *PlaceInDepth(drawing.parts, drawing.graph, AssembleCreature(drawing.graph, *skeletons));
}

std::vector<Chain> RandomChains(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Chain> chains(2);
  for (Chain& chain : chains) {
    Vector2d position(uniform(random), uniform(random));
    for (int i = 0; i < 4; ++i) {
      chain.vertices.push_back({position, std::exp(0.5 * uniform(random))});
      position += Vector2d(1.2 + 0.5 * uniform(random), uniform(random));
    }
  }
  chains.push_back({{{{uniform(random), uniform(random)}, 0.8}}});
  return chains;
}

TEST(PlanarField, IsTheCreaturesFieldInItsPlane) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-4, 6);
  for (int round = 0; round < 50; ++round) {
    Creature creature;
    creature.parts.push_back({0, RandomChains(random), {}, 2, false, 1});
    const Field field = MakeField(creature, {});
    PlanarField planar(creature.parts[0].chains);
    PlanarSample sample;
    for (int i = 0; i < 40; ++i) {
      const Vector2d p(uniform(random), uniform(random));
      planar.Evaluate(p, sample);
      const FieldSample exact = Evaluate(field, {p.x(), -p.y(), 2});
      EXPECT_NEAR(sample.value, exact.value, 2e-4 * std::max(1.0, exact.value))
          << "round " << round;
      EXPECT_NEAR(sample.gradient.x(), exact.gradient.x(), 2e-3) << "round " << round;
      EXPECT_NEAR(sample.gradient.y(), -exact.gradient.y(), 2e-3) << "round " << round;
    }
  }
}

TEST(PlanarField, DerivativesAgreeWithDifferences) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-2, 5);
  constexpr double kStep = 1e-5;
  for (int round = 0; round < 20; ++round) {
    const std::vector<Chain> chains = RandomChains(random);
    const Vector2d p(uniform(random), uniform(random));
    PlanarSample sample, low, high;
    PlanarField(chains).Evaluate(p, sample);
    std::vector<double> derivatives(27, 0);
    auto value = sample.derivatives.begin();
    for (const PlanarSample::Run& run : sample.runs) {
      for (int i = 0; i < run.count; ++i) derivatives[Index(run.first + i)] += *value++;
      value += run.FilledUp() - run.count;
    }
    std::size_t index = 0;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      for (std::size_t v = 0; v < chains[c].vertices.size(); ++v) {
        for (int k = 0; k < 3; ++k, ++index) {
          const auto moved = [&](double step) {
            std::vector<Chain> copy = chains;
            SkeletonVertex& vertex = copy[c].vertices[v];
            if (k == 0) vertex.radius *= std::exp(step);
            if (k == 1) vertex.position.x() += step;
            if (k == 2) vertex.position.y() += step;
            return copy;
          };
          PlanarField(moved(-kStep)).Evaluate(p, low);
          PlanarField(moved(kStep)).Evaluate(p, high);
          EXPECT_NEAR(derivatives[index], (high.value - low.value) / (2 * kStep),
                      1e-3 * std::max(1.0, std::abs(derivatives[index])))
              << "round " << round << ", chain " << c << ", vertex " << v << ", unknown " << k;
        }
      }
    }
  }
}

TEST(FitToDrawing, BringsTheSilhouetteToTheOutline) {
  struct Case {
    const char* name;
    Outline outline;
    double max, mean;  // shares of the diagonal
  };
  for (const Case& c :
       {Case{"capsule", testing::Capsule({-3, 0}, {3, 0}, 1), 0.002, 0.001},
        Case{"ellipse", testing::Ellipse({0, 0}, 3, 1.4), 0.003, 0.001},
        Case{"ear", testing::Ear(), 0.008, 0.003}, Case{"leg", testing::Leg(), 0.006, 0.001}}) {
    const testing::Drawing drawing = testing::OnlyBody(c.outline);
    const Creature creature = Placed(drawing);
    const auto fitted = FitToDrawing(drawing.parts, creature);
    ASSERT_TRUE(fitted.ok());
    const FitError before = MeasureFit(drawing.parts, creature)[0];
    const FitError after = MeasureFit(drawing.parts, *fitted)[0];
    EXPECT_LT(after.max, c.max) << c.name << " began at " << before.max;
    EXPECT_LT(after.mean, c.mean) << c.name << " began at " << before.mean;
  }
}

TEST(SampleOutline, TakesCornersAndIsEvenBetweenThem) {
  const testing::Drawing drawing = testing::OnlyBody(testing::Crotches());
  const Outline& outline = drawing.parts.parts[0].outline;
  constexpr double kSpacing = 0.13;
  const std::vector<OutlineSample> samples = SampleOutline(outline, kSpacing);
  for (const Vector2d& crotch : testing::kCrotches) {
    EXPECT_TRUE(std::any_of(samples.begin(), samples.end(), [&](const OutlineSample& s) {
      return (s.point - crotch).norm() < 1e-9;
    }));
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_LE((samples[(i + 1) % samples.size()].point - samples[i].point).norm(),
              kSpacing * (1 + 1e-9));
  }
}

TEST(FitToDrawing, CrotchesAreMet) {
  const testing::Drawing drawing = testing::OnlyBody(testing::Crotches());
  const Creature creature = Placed(drawing);
  const auto fitted = FitToDrawing(drawing.parts, creature);
  ASSERT_TRUE(fitted.ok());
  const double diagonal = Diagonal(drawing.parts.parts[0].outline.points);
  const Field before = MakeField(creature, {}), after = MakeField(*fitted, {});
  for (const Vector2d& crotch : testing::kCrotches) {
    const auto off = [&](const Field& field) {
      return SignedDistance(Evaluate(field, {crotch.x(), -crotch.y(), 0})) / diagonal;
    };
    EXPECT_LT(std::abs(off(after)), 0.006) << "began at " << off(before);
  }
}

TEST(FitToDrawing, EndsNoWorseThanItBegan) {
  FitOptions options;
  const double checked = options.sample_spacing / 2, independent = 7e-4;
  double before_sum = 0, after_sum = 0;
  for (std::uint32_t seed = 0; seed < 25; ++seed) {
    const testing::Drawing drawing = testing::OnlyBody(testing::RandomBlob(seed));
    const Creature creature = Placed(drawing);
    const auto fitted = FitToDrawing(drawing.parts, creature);
    ASSERT_TRUE(fitted.ok());
    const FitError before = MeasureFit(drawing.parts, creature, independent)[0];
    const FitError after = MeasureFit(drawing.parts, *fitted, independent)[0];
    EXPECT_LE(after.max, before.max) << "seed " << seed;
    EXPECT_LT(after.max, 0.025) << "seed " << seed;
    before_sum += before.mean;
    after_sum += after.mean;
    // From where little can be gained.
    options.target = 0;
    const auto again = FitToDrawing(drawing.parts, *fitted, options);
    EXPECT_LE(MeasureFit(drawing.parts, *again, checked)[0].max,
              MeasureFit(drawing.parts, *fitted, checked)[0].max)
        << "seed " << seed;
  }
  EXPECT_LT(after_sum, 0.15 * before_sum);
}

TEST(FitToDrawing, KeepsDepthsAndChains) {
  const testing::Drawing drawing = testing::MakeBeast();
  const Creature creature = Placed(drawing);
  const auto fitted = FitToDrawing(drawing.parts, creature);
  ASSERT_TRUE(fitted.ok());
  ASSERT_EQ(fitted->parts.size(), creature.parts.size());
  for (std::size_t i = 0; i < creature.parts.size(); ++i) {
    EXPECT_EQ(fitted->parts[i].z, creature.parts[i].z);
    EXPECT_EQ(fitted->parts[i].chains.size(), creature.parts[i].chains.size());
    for (const Chain& chain : fitted->parts[i].chains) {
      for (const SkeletonVertex& v : chain.vertices) {
        EXPECT_TRUE(v.position.allFinite() && v.radius > 0);
      }
    }
  }
}

TEST(FitToDrawing, JointsWeighLittleAndOtherSharedPiecesCount) {
  const testing::Drawing drawn = testing::OnlyBody(testing::Ear());
  testing::Drawing shared = drawn;
  for (OutlineKind& kind : shared.parts.parts[0].outline.kinds) kind = OutlineKind::kShared;
  const Creature start = Placed(drawn);
  EXPECT_EQ(*FitToDrawing(shared.parts, start), *FitToDrawing(drawn.parts, start));
  // With a child whose outline runs all along it, nothing of it is a silhouette.
  shared.Add(testing::Ear(), PartRole::kSagittal, 0);
  Creature covered = start;
  covered.parts.push_back(start.parts[0]);
  covered.parts[1].part = 1;
  covered.parts[1].parent = 0;
  EXPECT_EQ(MeasureFit(shared.parts, covered)[0], FitError{});
}

TEST(FitToDrawing, ThreadsDoNotChangeTheResult) {
  const testing::Drawing drawing = testing::MakeBeast();
  const Creature creature = Placed(drawing);
  Execution one, many;
  one.threads = 1;
  many.threads = 4;
  EXPECT_EQ(*FitToDrawing(drawing.parts, creature, {}, one),
            *FitToDrawing(drawing.parts, creature, {}, many));
}

}  // namespace
}  // namespace lascaux

#include "lascaux/skeleton/normalise_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lascaux/field/field.h"
#include "lascaux/skeleton/fit.h"
#include "skeleton/index.h"
#include "skeleton/ring.h"
#include "skeleton/shapes.h"
#include "skeleton/union_outline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// The creature of a drawing without any fit: caps and slopes alone.
Field RawField(const testing::Drawing& drawing, const ModelFrame& frame) {
  const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  EXPECT_TRUE(skeletons.ok());
  return MakeField(
      *PlaceInDepth(drawing.parts, drawing.graph, AssembleCreature(drawing.graph, *skeletons)),
      frame);
}

/// And with it.
Field FittedField(const testing::Drawing& drawing, const ModelFrame& frame) {
  const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  const auto fitted = FitToDrawing(drawing.parts, AssembleCreature(drawing.graph, *skeletons));
  return MakeField(*PlaceInDepth(drawing.parts, drawing.graph, *fitted), frame);
}

/// log of the greatest F over z at a place of the sketch, by brute force.
double LogGreatest(const Field& field, const ModelFrame& frame, const Vector2d& place) {
  const Vector2d at = frame.ToModel(place);
  double greatest = 0;
  for (int k = 0; k <= 300; ++k)
    greatest = std::max(greatest, Evaluate(field, {at.x(), at.y(), 0.1 * k}).value);
  return std::log(greatest);
}

/// Greatest |log max F| on the outline of a body.
double WorstOn(const Field& field, const ModelFrame& frame, const Outline& outline) {
  double worst = 0;
  for (const OutlineSample& sample : SampleOutline(outline, 0.05)) {
    worst = std::max(worst, std::abs(LogGreatest(field, frame, sample.point)));
  }
  return worst;
}

TEST(NormaliseOutline, PutsTheSilhouetteOfABodyOnItsOutline) {
  const testing::Drawing drawing = testing::OnlyBody(testing::RandomBlob(3));
  const ModelFrame frame = FrameOf(drawing.parts, drawing.graph, 100);
  const Field raw = RawField(drawing, frame);
  const Field exact = NormaliseOutline(raw, {drawing.parts, drawing.graph, frame});
  const Outline& outline = drawing.parts.parts[0].outline;
  const double before = WorstOn(raw, frame, outline), after = WorstOn(exact, frame, outline);
  EXPECT_GT(before, 0.05);
  EXPECT_LT(after, 0.15 * before);
}

TEST(NormaliseOutline, LeavesTheMiddleOfTheBodyAlone) {
  const testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 8, 5));
  const ModelFrame frame = FrameOf(drawing.parts, drawing.graph, 100);
  const Field raw = RawField(drawing, frame);
  const Field exact = NormaliseOutline(raw, {drawing.parts, drawing.graph, frame});
  const Vector2d middle = frame.ToModel({0, 0});
  EXPECT_EQ(Evaluate(raw, {middle.x(), middle.y(), 3}).value,
            Evaluate(exact, {middle.x(), middle.y(), 3}).value);
}

/// How far along a ray of the sketch, its origin and direction, the surface is at the depth `z`.
double OutAlong(const Field& field, const ModelFrame& frame, const std::array<Vector2d, 2>& ray,
                double z) {
  double inside = 0, outside = 2;
  for (int i = 0; i < 30; ++i) {
    const double half = (inside + outside) / 2;
    const Vector2d at = frame.ToModel(ray[0] + half * ray[1]);
    (Evaluate(field, {at.x(), at.y(), z}).value > 1 ? inside : outside) = half;
  }
  return inside;
}

TEST(NormaliseOutline, WobblesOfThePenDoNotGoRoundTheBody) {
  constexpr int kWaves = 24, kPlaces = 480;
  constexpr double kPi = 3.14159265358979, kSize = 0.04, kWidth = 8, kHeight = 5, kStart = 1;
  std::vector<Vector2d> points;
  std::vector<std::array<Vector2d, 2>> rays;
  for (int i = 0; i < kPlaces; ++i) {
    const double turn = 2 * kPi * i / kPlaces;
    const Vector2d on(kWidth * std::cos(turn), kHeight * std::sin(turn));
    const Vector2d out =
        Vector2d(on.x() / kWidth / kWidth, on.y() / kHeight / kHeight).normalized();
    points.push_back(on + kSize * std::cos(kWaves * turn) * out);
    rays.push_back({on - kStart * out, out});
  }
  const testing::Drawing drawing = testing::OnlyBody(testing::Drawn(points));
  const ModelFrame frame = FrameOf(drawing.parts, drawing.graph, 100);
  const Field exact =
      NormaliseOutline(FittedField(drawing, frame), {drawing.parts, drawing.graph, frame});
  const auto wobble = [&](double z) {
    double sum = 0;
    for (int i = 0; i < kPlaces; ++i) {
      sum += std::cos(2 * kPi * kWaves * i / kPlaces) * OutAlong(exact, frame, rays[Index(i)], z);
    }
    return 2 * sum / kPlaces / kSize;
  };
  EXPECT_GT(wobble(0), 0.9);
  EXPECT_LT(wobble(0.4 * kHeight * frame.scale), 0.1);
}

TEST(NormaliseOutline, IsTheSameForAnyNumberOfThreads) {
  const testing::Drawing drawing = testing::MakeBeast();
  const ModelFrame frame = FrameOf(drawing.parts, drawing.graph, 100);
  const Field raw = RawField(drawing, frame);
  Execution one, two;
  one.threads = 1;
  two.threads = 2;
  EXPECT_EQ(NormaliseOutline(raw, {drawing.parts, drawing.graph, frame}, one),
            NormaliseOutline(raw, {drawing.parts, drawing.graph, frame}, two));
}

TEST(NormaliseOutline, GainStaysWithinItsBound) {
  const testing::Drawing drawing = testing::MakeBeast();
  const ModelFrame frame = FrameOf(drawing.parts, drawing.graph, 100);
  const Field exact =
      NormaliseOutline(RawField(drawing, frame), {drawing.parts, drawing.graph, frame});
  ASSERT_TRUE(exact.gain);
  for (const float c : exact.gain->coefficients) EXPECT_LE(std::abs(c), 3 * kMostLogGain);
}

TEST(UnionOutline, IsTheBoundaryOfWhatIsBuilt) {
  const testing::Drawing drawing = testing::MakeBeast();
  const double spacing = 0.05;
  const auto runs = UnionOutline(drawing.parts, drawing.graph, spacing);
  ASSERT_FALSE(runs.empty());
  for (const auto& run : runs) {
    for (const Vector2d& p : run) {
      for (std::size_t i = 0; i < drawing.parts.parts.size(); ++i) {
        const PartRole role = drawing.graph.nodes[i].role;
        if (role == PartRole::kBackground || role == PartRole::kIsland) continue;
        EXPECT_GT(SignedDistanceToRing(drawing.parts.parts[i].outline.points, p), -2 * spacing)
            << "part " << i;
      }
    }
  }
}

TEST(UnionOutline, OfOneBodyIsItsWholeOutline) {
  const testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 8, 5));
  const auto runs = UnionOutline(drawing.parts, drawing.graph, 0.05);
  double length = 0;
  for (const auto& run : runs) {
    for (std::size_t k = 1; k < run.size(); ++k) length += (run[k] - run[k - 1]).norm();
  }
  EXPECT_NEAR(length, Perimeter(drawing.parts.parts[0].outline.points), 0.1);
}

}  // namespace
}  // namespace lascaux

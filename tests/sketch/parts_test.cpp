#include "lascaux/sketch/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "sketch/drawings.h"
#include "sketch/map/polyline.h"
#include "sketch/parts/completion.h"

namespace lascaux {
namespace {

using namespace testing;
using Eigen::Vector2d;

Parts PartsOf(const Sketch& sketch) {
  const auto map = BuildPlanarMap(sketch);
  EXPECT_TRUE(map);
  return map ? *FindParts(*map) : Parts{};
}

std::vector<Part> OfKind(const Parts& parts, PartKind kind) {
  std::vector<Part> found;
  std::copy_if(parts.parts.begin(), parts.parts.end(), std::back_inserter(found),
               [&](const Part& p) { return p.kind == kind; });
  return found;
}

bool IsOneOf(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  return (p - a).norm() < 1e-6 || (p - b).norm() < 1e-6;
}

TEST(Completion, EnergyHasNoScale) {
  const CubicBezier curve{{Vector2d(0, 0), Vector2d(1, 2), Vector2d(3, 2.5), Vector2d(4, 0)}};
  CubicBezier large = curve;
  for (Vector2d& p : large.p) p *= 1e6;
  EXPECT_NEAR(CurvatureVariation(large) / CurvatureVariation(curve), 1, 1e-9);
}

TEST(Completion, StraightLineCostsNothingAndKeepsItsTangents) {
  const Completion completion = Complete({{0, 0}, {1, 0}}, {{10, 0}, {-1, 0}});
  EXPECT_NEAR(completion.energy, 0, 1e-9);
  const Completion bow = Complete({{0, 0}, {0, -1}}, {{10, 0}, {0, -1}});
  EXPECT_NEAR(bow.curve.StartTangent().y(), -1, 1e-12);
  EXPECT_NEAR(bow.curve.EndTangent().y(), 1, 1e-12);
}

TEST(Completion, StaysInsideTheRing) {
  const Polyline box{{-1, -3}, {11, -3}, {11, 1}, {-1, 1}};
  for (const Vector2d& p : CompleteInside({{0, 0}, {0, -1}}, {{10, 0}, {0, -1}}, box))
    EXPECT_TRUE(Contains(box, p)) << p;
}

TEST(Parts, TwoSuggestiveCurvesCutALimb) {
  const Parts parts = PartsOf(Quadruped());
  const auto limbs = OfKind(parts, PartKind::kLimb);
  ASSERT_EQ(limbs.size(), 1u);
  ASSERT_TRUE(limbs[0].root);
  EXPECT_EQ(limbs[0].root->evidence, LimbEvidence::kTwoCurves);
  for (const Vector2d& p : limbs[0].root->closed) EXPECT_TRUE(IsOneOf(p, {100, 200}, {150, 200}));
  for (const Vector2d& p : limbs[0].root->open) EXPECT_TRUE(IsOneOf(p, {105, 130}, {145, 130}));
  EXPECT_TRUE(Contains(limbs[0].outline.points, {125, 260}));
  EXPECT_TRUE(Contains(limbs[0].outline.points, {125, 150}));
  EXPECT_FALSE(Contains(limbs[0].outline.points, {125, 60}));
}

TEST(Parts, WhatIsLeftOfTheFaceIsTheBodyWithTheLimbsRootCompleted) {
  const Parts parts = PartsOf(Quadruped());
  const auto borders = OfKind(parts, PartKind::kBorder);
  ASSERT_EQ(borders.size(), 3u);  // torso, far leg, tail
  const auto torso =
      std::max_element(borders.begin(), borders.end(), [](const Part& a, const Part& b) {
        return SignedArea(a.outline.points) < SignedArea(b.outline.points);
      });
  EXPECT_TRUE(Contains(torso->outline.points, {125, 150}));
  EXPECT_FALSE(Contains(torso->outline.points, {125, 260}));
  EXPECT_EQ(torso->stretches.size(), 1u);
  EXPECT_TRUE(std::count(torso->outline.kinds.begin(), torso->outline.kinds.end(),
                         OutlineKind::kCompletion) > 0);
  EXPECT_TRUE(std::count(torso->outline.kinds.begin(), torso->outline.kinds.end(),
                         OutlineKind::kShared) > 0);
}

TEST(Parts, OutlinesAreRingsOfPositiveAreaWithAKindForEachPiece) {
  for (const Part& part : PartsOf(Quadruped()).parts) {
    EXPECT_GT(SignedArea(part.outline.points), 0);
    EXPECT_EQ(part.outline.points.size(), part.outline.kinds.size());
    for (std::size_t i = 0; i < part.outline.points.size(); ++i) {
      EXPECT_NE(part.outline.points[i], part.outline.points[(i + 1) % part.outline.points.size()]);
    }
  }
}

TEST(Parts, OneSuggestiveCurveAndTheRumpCutAHindLeg) {
  // The leg's front runs on into the body as one curve; its back is the rump.
  const Sketch sketch =
      SketchOf({Straight({{300, 200},
                          {40, 200},
                          {20, 120},
                          {60, 50},
                          {300, 40},
                          {400, 70},
                          {415, 150},
                          {400, 230},
                          {385, 380},
                          {345, 380}}),
                Straight({{345, 380}, {338, 270}, {300, 200}, {295, 150}, {300, 110}})});
  const auto limbs = OfKind(PartsOf(sketch), PartKind::kLimb);
  ASSERT_EQ(limbs.size(), 1u);
  EXPECT_EQ(limbs[0].root->evidence, LimbEvidence::kOneCurve);
  EXPECT_TRUE(Contains(limbs[0].outline.points, {365, 350}));
  EXPECT_FALSE(Contains(limbs[0].outline.points, {150, 120}));
}

TEST(Parts, MouthAndFloatingStrokesCutNothing) {
  const Sketch sketch = SketchOf({Loop({{0, 0}, {300, 0}, {300, 150}, {0, 150}}),
                                  Straight({{0, 70}, {60, 75}}), Straight({{120, 40}, {160, 60}})});
  EXPECT_TRUE(OfKind(PartsOf(sketch), PartKind::kLimb).empty());
}

TEST(Parts, ClosedCurveInsideIsAnIsland) {
  EXPECT_EQ(OfKind(PartsOf(Quadruped()), PartKind::kIsland).size(), 1u);
}

TEST(Parts, ReversedAndShuffledStrokesGiveTheSameLimbs) {
  Sketch other = Quadruped();
  std::reverse(other.strokes.begin(), other.strokes.end());
  for (Stroke& stroke : other.strokes) {
    std::reverse(stroke.pieces.begin(), stroke.pieces.end());
    for (CubicBezier& piece : stroke.pieces) piece = Reversed(piece);
  }
  const auto a = OfKind(PartsOf(Quadruped()), PartKind::kLimb),
             b = OfKind(PartsOf(other), PartKind::kLimb);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_NEAR(SignedArea(a[0].outline.points), SignedArea(b[0].outline.points), 1e-6);
}

TEST(Ring, AreaAndInsideOfASquare) {
  const Points square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_DOUBLE_EQ(SignedArea(square), 4);
  EXPECT_TRUE(Contains(square, {1, 1}));
  EXPECT_FALSE(Contains(square, {3, 1}));
}

/// A torso with lobes hanging from its lower side: the outline of an animal, nothing else.
Sketch Silhouette(const std::vector<double>& legs, double foot = 60) {
  Points outline{{0, 0}, {200, 0}, {200, 60}};
  for (auto x = legs.rbegin(); x != legs.rend(); ++x) {
    for (const Vector2d& p : {Vector2d(*x + 10, 60), Vector2d(*x + 9, 60 + foot),
                              Vector2d(*x - 9, 60 + foot), Vector2d(*x - 10, 60)})
      outline.push_back(p);
  }
  outline.push_back({0, 60});
  return SketchOf({Loop(outline)});
}

TEST(Parts, LoneLobesThatStandOnTheGroundAreLegs) {
  const Parts parts = PartsOf(Silhouette({30, 170}));
  const auto limbs = OfKind(parts, PartKind::kLimb);
  ASSERT_EQ(limbs.size(), 2u);
  for (const Part& limb : limbs) {
    ASSERT_TRUE(limb.root);
    EXPECT_EQ(limb.root->evidence, LimbEvidence::kNeck);
    for (const Vector2d& closed : limb.root->closed) EXPECT_NEAR(closed.y(), 60, 3);
    EXPECT_EQ(limb.over, 0);
  }
  // The torso is whole below them.
  EXPECT_NEAR(SignedArea(parts.parts.front().outline.points), 12'000, 300);
}

TEST(Parts, OfTwoLobesSideBySideOneIsTheFarSideOfTheOther) {
  const Parts parts = PartsOf(Silhouette({20, 48, 152, 180}));
  EXPECT_EQ(OfKind(parts, PartKind::kLimb).size(), 2u);
  int far = 0;
  for (const Part& part : parts.parts) {
    if (!part.far_side_of) continue;
    ++far;
    EXPECT_EQ(part.kind, PartKind::kBorder);
    EXPECT_EQ(parts.parts[static_cast<std::size_t>(*part.far_side_of)].kind, PartKind::kLimb);
  }
  EXPECT_EQ(far, 2);
}

TEST(Parts, LobesThatHangInTheAirOrLieAreNoLegs) {
  // A third one that ends higher than two that stand.
  Sketch trunk = Silhouette({20, 100});
  EXPECT_EQ(OfKind(PartsOf(trunk), PartKind::kLimb).size(), 2u);
  EXPECT_EQ(OfKind(PartsOf(Silhouette({}, 0)), PartKind::kLimb).size(), 0u);
  // Broader than long.
  EXPECT_EQ(OfKind(PartsOf(Silhouette({30, 170}, 12)), PartKind::kLimb).size(), 0u);
  Sketch upside_down = Silhouette({30, 170});
  for (CubicBezier& piece : upside_down.strokes.front().pieces) {
    for (Vector2d& p : piece.p) p = -p;
  }
  EXPECT_EQ(OfKind(PartsOf(upside_down), PartKind::kLimb).size(), 0u);
}

}  // namespace
}  // namespace lascaux

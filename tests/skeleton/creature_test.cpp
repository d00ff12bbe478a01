#include "lascaux/skeleton/creature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "skeleton/chains.h"
#include "skeleton/index.h"
#include "skeleton/ring.h"
#include "skeleton/shapes.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Creature Placed(const testing::Drawing& drawing, const PlaceInDepthOptions& options = {}) {
  const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  EXPECT_TRUE(skeletons.ok());
  auto creature = PlaceInDepth(drawing.parts, drawing.graph,
                               AssembleCreature(drawing.graph, *skeletons), options);
  EXPECT_TRUE(creature.ok());
  return *creature;
}

const CreaturePart& PartOf(const Creature& creature, int part) {
  return *std::find_if(creature.parts.begin(), creature.parts.end(),
                       [part](const CreaturePart& p) { return p.part == part; });
}

TEST(Chains, EachEdgeIsInOneChainAndTheLongestComesFirst) {
  Skeleton tree;
  tree.vertices = {{{0, 0}, 1}, {{4, 0}, 1},    {{8, 0}, 1},
                   {{4, 3}, 1}, {{4, -1}, 0.5}, {{8, 2}, 0.5}};
  tree.edges = {{{0, 1}}, {{1, 2}}, {{1, 3}}, {{1, 4}}, {{2, 5}}};
  const std::vector<Chain> chains = CutIntoChains(tree);
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[0].vertices.size(), 4u);
  EXPECT_EQ(chains[1].vertices.size(), 2u);
  EXPECT_EQ(chains[1].vertices[0].position, Vector2d(4, 0));
  EXPECT_EQ(chains[1].vertices[1].position, Vector2d(4, 3));
  EXPECT_EQ(chains[2].vertices[1].position, Vector2d(4, -1));
}

TEST(Chains, ASingleVertexIsABall) {
  Skeleton tree;
  tree.vertices = {{{1, 2}, 0.5}};
  const std::vector<Chain> chains = CutIntoChains(tree);
  ASSERT_EQ(chains.size(), 1u);
  Field field;
  field.parts.push_back({{MakeFieldChain(chains[0], {}, 3)}, {}, 3, 1});
  for (const Vector3d& n : {Vector3d(1, 0, 0), Vector3d(0, 0.6, 0.8), Vector3d(0, 0, -1)}) {
    EXPECT_NEAR(Evaluate(field, Vector3d(1, -2, 3) + 0.5 * n).value, 1, 1e-12);
  }
}

TEST(Chains, CapsEndInHalfBalls) {
  for (const double length : {0.1, 0.5, 1.0, 4.0}) {
    const Chain chain{{{{0, 0}, 1}, {{length, 0}, 1}}};
    Field field;
    field.parts.push_back({{MakeFieldChain(chain, {}, 0)}, {}, 0, 1});
    for (int i = 0; i <= 32; ++i) {
      const double t = 3.14159265 * (i / 32.0 - 0.5);
      const Vector3d p(length + std::cos(t), std::sin(t), 0);
      EXPECT_NEAR(SignedDistance(Evaluate(field, p)), 0, length < 1 ? 0.04 : 0.022)
          << "length " << length << ", angle " << t;
    }
  }
}

TEST(Chains, RefinementKeepsTheDiscsAndShortensTheEdges) {
  const Chain chain{{{{0, 0}, 1}, {{10, 0}, 2}, {{10, 3}, 1e-9}}};
  const Chain refined = Refined(chain);
  for (std::size_t i = 0; i + 1 < refined.vertices.size(); ++i) {
    const SkeletonVertex &a = refined.vertices[i], &b = refined.vertices[i + 1];
    EXPECT_LE((b.position - a.position).norm(), 2.5);
    EXPECT_GE(a.radius, 1e-3);
    if (a.position.y() == 0 && b.position.y() == 0) {
      EXPECT_NEAR(a.radius, 1 + 0.1 * a.position.x(), 1e-12);
    }
  }
}

TEST(PlaceInDepth, BodyAndSagittalPartsAreInThePlaneAndOnce) {
  const Creature beast = Placed(testing::MakeBeast());
  for (const int part : {testing::kBody, testing::kTail}) {
    EXPECT_EQ(PartOf(beast, part).z, 0);
    EXPECT_FALSE(PartOf(beast, part).mirrored);
  }
  EXPECT_EQ(beast.parts.size(), 6u);
}

TEST(PlaceInDepth, LimbsStandApartAndReachIntoTheBody) {
  const testing::Drawing drawing = testing::MakeBeast();
  const Creature beast = Placed(drawing);
  for (const int part : {testing::kFrontLeg, testing::kHindLeg}) {
    const CreaturePart& leg = PartOf(beast, part);
    EXPECT_TRUE(leg.mirrored);
    const double radius = part == testing::kFrontLeg ? 0.45 : 0.5;
    EXPECT_GE(leg.z - radius, 0.149 * radius);
    // The body is 1.2 to 1.4 deep there, and the leg's axis is inside of it.
    EXPECT_LT(leg.z, 1.4 - 0.3 * radius);
  }
}

TEST(PlaceInDepth, LegsStandStraightAndFlushWithTheFlank) {
  const testing::Drawing drawing = testing::MakeBeast();
  const Creature beast = Placed(drawing);
  const Field body = MakeField(Creature{{PartOf(beast, testing::kBody)}}, {});
  double flank = 0;
  while (Evaluate(body, {-2, 0, flank}).value > 1) flank += 1e-3;
  const CreaturePart& leg = PartOf(beast, testing::kFrontLeg);
  for (const DepthStation& station : leg.stations) {
    if (station.position.y() < 2) continue;  // where it comes out of the body
    EXPECT_NEAR(station.z, leg.z, 1e-9);
    EXPECT_NEAR(station.z + station.scale * 0.45, flank, 0.05 * flank);
  }
}

TEST(PlaceInDepth, LegsThatBeginAtTheBellyComeStraightDownOutOfTheFlank) {
  testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 4, 2));
  const int leg = drawing.Add(testing::Capsule({1, 1.9}, {1, 5}, 0.4), PartRole::kForeground, 0);
  const Creature beast = Placed(drawing);
  const CreaturePart& part = PartOf(beast, leg);
  for (const DepthStation& station : part.stations) EXPECT_NEAR(station.z, part.z, 1e-9);
  ASSERT_EQ(part.chains.size(), 2u);  // the leg, and a shoulder
  const Field body = MakeField(Creature{{PartOf(beast, 0)}}, {}), field = MakeField(beast, {});
  const auto front = [](const Field& f, double y) {
    double z = 3;
    while (z > 0 && Evaluate(f, {1, -y, z}).value < 1) z -= 2e-3;
    return z;
  };
  // The leg's outer face is flush with the deepest place of the body, and nowhere does the shoulder
  // stand out by more than the blend.
  const double flank = front(body, 0.2);
  EXPECT_NEAR(front(field, 3.5), flank, 0.05 * flank);
  for (double y = -1.5; y < 0.5; y += 0.25) {
    EXPECT_LT(front(field, y), 1.05 * flank) << "y " << y;
  }
  // No gap on the way up into the body, and from the side no more than body and leg.
  for (double y = 1.0; y < 5; y += 0.05) EXPECT_GT(Evaluate(field, {1, -y, part.z}).value, 1) << y;
  for (const SkeletonVertex& v : part.chains.back().vertices) {
    EXPECT_LE(SignedDistanceToRing(drawing.parts.parts[0].outline.points, v.position), -v.radius);
  }
}

TEST(PlaceInDepth, LimbsThatRiseLeanOutAndThoseThatLieOnTheBodyFollowIt) {
  testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 4, 2));
  const int horn = drawing.Add(testing::Capsule({2, -1}, {2.5, -4}, 0.3), PartRole::kForeground, 0);
  const int wing = drawing.Add(testing::Capsule({-2, 0}, {1, 0.2}, 0.5), PartRole::kForeground, 0);
  const Creature beast = Placed(drawing);
  const Field body = MakeField(Creature{{PartOf(beast, 0)}}, {});
  for (const DepthStation& station : PartOf(beast, wing).stations) {
    const Vector3d middle(station.position.x(), -station.position.y(), station.z);
    EXPECT_GT(Evaluate(body, middle).value, 1);
    EXPECT_LT(Evaluate(body, middle + Vector3d(0, 0, 0.5 * station.scale)).value, 1);
  }
  double low = 1e9, high = 0;
  for (const DepthStation& station : PartOf(beast, horn).stations) {
    low = std::min(low, station.z), high = std::max(high, station.z);
  }
  EXPECT_GT(high - low, 0.3);
  EXPECT_LT(high - low, 0.71 * 3);
}

TEST(PlaceInDepth, APointedEarLeansOutUpToItsTipAndNeverBack) {
  testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 1}, 4, 2));
  const int ear = drawing.Add(testing::Ear(), PartRole::kForeground, 0);
  const Creature beast = Placed(drawing);
  const Field field = MakeField(beast, {});
  // The body comes first, and once.
  ASSERT_EQ(beast.parts[1].part, ear);
  const FieldPart& shape = field.parts[1];
  ASSERT_TRUE(shape.depth.has_value());
  double before = EvaluateDepth(*shape.depth, {0, 1.5}).middle;
  // Half a voxel beyond the tip, which is at the edge of the part's support, its depth goes on.
  for (double y = 1.55; y < 3.02; y += 0.05) {
    const DepthSample depth = EvaluateDepth(*shape.depth, {0, y});
    EXPECT_GT(depth.middle, before) << "y " << y;
    EXPECT_GT(depth.middle_gradient.y(), 0.25) << "y " << y;
    EXPECT_LT(depth.middle_gradient.y(), 0.9) << "y " << y;
    before = depth.middle;
  }
}

TEST(PlaceInDepth, TheTipsOfLongEarsAreHardlyFurtherOutThanThoseOfShorterOnes) {
  // Ears of one width, so many radii of theirs high.
  std::vector<double> out;
  for (const double height : {1.5, 3.0, 5.0, 8.0}) {
    testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 4, 2));
    constexpr double kRadius = 0.4;
    const int ear = drawing.Add(testing::Capsule({1, -1.5}, {1, -1.5 - height * kRadius}, kRadius),
                                PartRole::kForeground, 0);
    const Creature beast = Placed(drawing);
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const DepthStation& station : PartOf(beast, ear).stations) {
      low = std::min(low, station.z), high = std::max(high, station.z);
    }
    out.push_back(high - low);
  }
  EXPECT_GT(out[1], 1.3 * out[0]);
  EXPECT_LT(out[3], 1.25 * out[2]);  // and not 1.6 times as far
  EXPECT_GT(out[3], out[1]);
}

TEST(PlaceInDepth, BelliesAreFullerThanBacksAndFinsThin) {
  // An ellipse with a triangle on its back.
  std::vector<Vector2d> ring;
  for (int i = 0; i < 200; ++i) {
    const double t = 2 * 3.14159265358979 * i / 200;
    const Vector2d p(6 * std::cos(t), 2 * std::sin(t));
    const double rise = p.y() < 0 ? std::max(0.0, 1 - std::abs(p.x())) : 0;
    ring.emplace_back(p.x(), p.y() - 2 * rise);
  }
  const Creature whale = Placed(testing::OnlyBody(testing::Drawn(ring)));
  const Field field = MakeField(whale, {});
  const auto depth = [&](double x, double y) {
    double z = 0;
    while (Evaluate(field, {x, -y, z}).value > 1) z += 1e-3;
    return z;
  };
  EXPECT_GT(depth(3, 1.2), 1.1 * depth(3, -1.2));
  EXPECT_LT(depth(0, -3), 0.8 * 0.5);  // the triangle is 0.5 to either side there
}

TEST(PlaceInDepth, AWiderGapSetsLimbsFurtherOutUntilTheyWouldComeOff) {
  const testing::Drawing drawing = testing::MakeBeast();
  PlaceInDepthOptions options;
  double before = 0;
  for (const double gap : {0.0, 2.0, 4.0}) {
    options.pair_gap = gap;
    const double z = PartOf(Placed(drawing, options), testing::kHindLeg).z;
    EXPECT_GE(z, before);
    before = z;
  }
  options.pair_gap = 50;
  const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  const auto creature = PlaceInDepth(drawing.parts, drawing.graph,
                                     AssembleCreature(drawing.graph, *skeletons), options);
  ASSERT_TRUE(creature.ok());
  const bool noted = std::any_of(creature.diagnostics().begin(), creature.diagnostics().end(),
                                 [](const Diagnostic& d) { return d.code == "pair-close"; });
  EXPECT_TRUE(noted);
  EXPECT_LT(PartOf(*creature, testing::kHindLeg).z, 1.4 + 0.5);
}

TEST(PlaceInDepth, AnEyeShowsOnBothSidesAndHoldsToTheHead) {
  const Creature beast = Placed(testing::MakeBeast());
  const CreaturePart& eye = PartOf(beast, testing::kEye);
  EXPECT_TRUE(eye.mirrored);
  const Field field = MakeField(beast, {});
  Creature blind = beast;
  blind.parts.erase(std::find_if(blind.parts.begin(), blind.parts.end(),
                                 [](const CreaturePart& p) { return p.part == testing::kEye; }));
  for (CreaturePart& p : blind.parts) {
    if (p.parent && *p.parent > 3) p.parent = *p.parent - 1;
  }
  const Field without = MakeField(blind, {});
  const auto front = [](const Field& f, double side) {
    double z = 2;
    while (z > 0 && Evaluate(f, {-3, 0.3, side * z}).value < 1) z -= 0.004;
    return z;
  };
  for (const double side : {1.0, -1.0}) {
    // It stands out by about 0.6 of its radius of 0.15 along the normal.
    EXPECT_GT(front(field, side) - front(without, side), 0.06);
    // No gap between it and the head.
    for (double z = 0; z < front(field, side); z += 0.005) {
      EXPECT_GE(Evaluate(field, {-3, 0.3, side * z}).value, 1) << "z " << z;
    }
  }
}

TEST(PlaceInDepth, WhatSitsOnALimbHasItsDepthAndItsMirrorImage) {
  const Creature beast = Placed(testing::MakeBeast());
  const CreaturePart& hoof = PartOf(beast, testing::kHoof);
  EXPECT_EQ(hoof.z, PartOf(beast, testing::kFrontLeg).z);
  EXPECT_TRUE(hoof.mirrored);
}

TEST(PlaceInDepth, APartAwayFromItsParentIsReported) {
  testing::Drawing drawing = testing::OnlyBody(testing::Ellipse({0, 0}, 2, 1));
  drawing.Add(testing::Ellipse({9, 0}, 1, 1), PartRole::kSagittal, 0);
  const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  ASSERT_TRUE(skeletons.ok());
  const auto creature =
      PlaceInDepth(drawing.parts, drawing.graph, AssembleCreature(drawing.graph, *skeletons));
  ASSERT_TRUE(creature.ok());
  ASSERT_EQ(creature.diagnostics().size(), 1u);
  EXPECT_EQ(creature.diagnostics()[0].code, "part-loose");
  EXPECT_TRUE(creature.diagnostics()[0].at.has_value());
}

TEST(FrameOf, StandsOnTheGroundWithTheLongestSideAsAsked) {
  const testing::Drawing beast = testing::MakeBeast();
  const ModelFrame frame = FrameOf(beast.parts, beast.graph, 100);
  // x from -4 to 7.25, y from -1.5 to 4; the far leg does not count.
  EXPECT_NEAR(frame.scale, 100 / 11.25, 1e-9);
  EXPECT_NEAR(frame.ToModel({-4, 4}).x(), -50, 1e-9);
  EXPECT_NEAR(frame.ToModel({7.25, 4}).x(), 50, 1e-9);
  EXPECT_NEAR(frame.ToModel({0, 4}).y(), 0, 1e-9);
  EXPECT_LT((frame.ToSketch(frame.ToModel({1, 2})) - Vector2d(1, 2)).norm(), 1e-12);
}

TEST(MakeField, MirroredPartsBlendWithTheirParentsOnTheirSide) {
  const testing::Drawing drawing = testing::MakeBeast();
  const Creature beast = Placed(drawing);
  const ModelFrame frame = FrameOf(drawing.parts, drawing.graph, 100);
  const Field field = MakeField(beast, frame);
  // Body, tail once; two legs, eye, hoof twice.
  ASSERT_EQ(field.parts.size(), 10u);
  EXPECT_TRUE(Validate(field).empty());
  for (std::size_t i = 0; i < field.parts.size(); ++i) {
    const FieldPart& part = field.parts[i];
    if (!part.parent) continue;
    EXPECT_LT(*part.parent, static_cast<int>(i));
    EXPECT_GE(part.z0 * field.parts[Index(*part.parent)].z0, 0);
  }
  for (const Vector3d& p : {Vector3d(-20, 15, 7), Vector3d(10, 30, 3), Vector3d(-30, 40, 9)}) {
    const Vector3d image(p.x(), p.y(), -p.z());
    EXPECT_NEAR(Evaluate(field, p).value, Evaluate(field, image).value, 1e-12);
  }
}

}  // namespace
}  // namespace lascaux

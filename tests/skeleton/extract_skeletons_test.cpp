#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "lascaux/skeleton/skeleton.h"
#include "skeleton/extend_outline.h"
#include "skeleton/index.h"
#include "skeleton/ring.h"
#include "skeleton/shapes.h"
#include "skeleton/simplify_skeleton.h"
#include "skeleton/tree.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::OnlyBody;

Skeleton SkeletonOf(const Outline& outline) {
  const testing::Drawing drawing = OnlyBody(outline);
  const Outcome<std::vector<Skeleton>> skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
  EXPECT_TRUE(skeletons.ok());
  return skeletons.ok() && skeletons->size() == 1 ? skeletons->front() : Skeleton{};
}

bool IsTree(const Skeleton& skeleton) {
  if (skeleton.vertices.empty() || skeleton.edges.size() + 1 != skeleton.vertices.size())
    return false;
  const std::vector<std::vector<int>> neighbours = Neighbours(skeleton);
  std::vector<char> seen(skeleton.vertices.size(), 0);
  std::vector<int> queue{0};
  seen[0] = 1;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const int w : neighbours[Index(queue[head])]) {
      if (!seen[Index(w)]) seen[Index(w)] = 1, queue.push_back(w);
    }
  }
  return queue.size() == skeleton.vertices.size();
}

int Leaves(const Skeleton& skeleton) {
  int leaves = 0;
  for (const std::vector<int>& n : Neighbours(skeleton)) leaves += n.size() == 1 ? 1 : 0;
  return leaves;
}

/// Largest distance of an outline point from the hulls of the discs.
double Uncovered(const Skeleton& skeleton, const Outline& outline) {
  double worst = 0;
  for (const Vector2d& p : outline.points) {
    double least = std::numeric_limits<double>::infinity();
    for (const SkeletonVertex& v : skeleton.vertices) {
      least = std::min(least, (p - v.position).norm() - v.radius);
    }
    for (const auto& [a, b] : skeleton.edges) {
      least = std::min(least,
                       DistanceToCone(skeleton.vertices[Index(a)], skeleton.vertices[Index(b)], p));
    }
    worst = std::max(worst, least);
  }
  return worst;
}

TEST(ExtractSkeletons, CircleIsOneDisc) {
  for (const double radius : {1e-3, 1.0, 1e4}) {
    const Skeleton skeleton = SkeletonOf(testing::Ellipse({3, -2}, radius, radius));
    ASSERT_EQ(skeleton.vertices.size(), 1u) << "radius " << radius;
    EXPECT_NEAR(skeleton.vertices[0].radius, radius, 1e-3 * radius);
    EXPECT_LT((skeleton.vertices[0].position - Vector2d(3, -2)).norm(), 1e-3 * radius);
  }
}

TEST(ExtractSkeletons, CapsuleIsItsAxis) {
  const Skeleton skeleton = SkeletonOf(testing::Capsule({-3, 1}, {3, 1}, 1));
  ASSERT_TRUE(IsTree(skeleton));
  EXPECT_EQ(Leaves(skeleton), 2);
  double left = 0, right = 0;
  for (const SkeletonVertex& v : skeleton.vertices) {
    EXPECT_NEAR(v.position.y(), 1, 0.01);
    EXPECT_NEAR(v.radius, 1, 0.01);
    left = std::min(left, v.position.x());
    right = std::max(right, v.position.x());
  }
  EXPECT_NEAR(left, -3, 0.05);
  EXPECT_NEAR(right, 3, 0.05);
}

TEST(ExtractSkeletons, EllipseHasTheRadiiOfItsMedialAxis) {
  const Skeleton skeleton = SkeletonOf(testing::Ellipse({0, 0}, 2, 1));
  ASSERT_TRUE(IsTree(skeleton));
  EXPECT_EQ(Leaves(skeleton), 2);
  for (const SkeletonVertex& v : skeleton.vertices) {
    EXPECT_NEAR(v.position.y(), 0, 0.01);
    const double x = v.position.x();
    EXPECT_NEAR(v.radius, std::sqrt(1 - x * x / 3), 0.01) << "x = " << x;
    EXPECT_LE(std::abs(x), 1.5);
  }
}

TEST(ExtractSkeletons, EarReachesItsTip) {
  const Skeleton skeleton = SkeletonOf(testing::Ear());
  ASSERT_TRUE(IsTree(skeleton));
  EXPECT_EQ(Leaves(skeleton), 2);
  double nearest = 10;
  for (const SkeletonVertex& v : skeleton.vertices) {
    nearest = std::min(nearest, (v.position - Vector2d(0, -3)).norm());
  }
  EXPECT_LT(nearest, 0.1);
}

TEST(ExtractSkeletons, CornersAboveTheScaleAxisAngleHaveNoBranch) {
  // 2 asin(1 / 1.2) = 112.9 degrees.
  constexpr double kDegree = std::numbers::pi / 180;
  EXPECT_EQ(SkeletonOf(testing::Wedge(120 * kDegree)).vertices.size(), 1u);
  EXPECT_GT(SkeletonOf(testing::Wedge(105 * kDegree)).vertices.size(), 1u);
}

TEST(ExtractSkeletons, NoiseAddsNoBranch) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-0.004, 0.004);
    Outline outline = testing::Ellipse({0, 0}, 2, 1);
    for (Vector2d& p : outline.points) p += Vector2d(noise(random), noise(random));
    const Skeleton skeleton = SkeletonOf(outline);
    EXPECT_TRUE(IsTree(skeleton)) << "seed " << seed;
    EXPECT_EQ(Leaves(skeleton), 2) << "seed " << seed;
  }
}

TEST(ExtractSkeletons, DiscsOfRandomOutlinesStayInsideAndCoverThem) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const Outline outline = testing::RandomBlob(seed);
    const Skeleton skeleton = SkeletonOf(outline);
    ASSERT_TRUE(IsTree(skeleton)) << "seed " << seed;
    double largest = 0;
    for (const SkeletonVertex& v : skeleton.vertices) largest = std::max(largest, v.radius);
    for (const SkeletonVertex& v : skeleton.vertices) {
      EXPECT_NEAR(SignedDistanceToRing(outline.points, v.position), -v.radius, 0.005 * largest)
          << "seed " << seed;
    }
    EXPECT_LT(Uncovered(skeleton, outline), 0.16 * largest) << "seed " << seed;
  }
}

TEST(ExtractSkeletons, FewPointsAndThinPartsHaveTrees) {
  const std::vector<std::vector<Vector2d>> rings{
      {{0, 0}, {4, 0}, {1, 3}},
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
      {{0, 0}, {100, 0}, {100, 0.5}, {0, 0.5}},
      {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}},
      {{0, 0}, {10, 0}, {10, 10}, {5.01, 10}, {5, 0.1}, {4.99, 10}, {0, 10}},
  };
  for (const std::vector<Vector2d>& ring : rings) {
    const Outline outline = testing::Drawn(ring);
    const Skeleton skeleton = SkeletonOf(outline);
    EXPECT_TRUE(IsTree(skeleton)) << ring.size() << " points";
    for (const SkeletonVertex& v : skeleton.vertices) {
      EXPECT_TRUE(v.position.allFinite() && v.radius > 0);
      EXPECT_TRUE(Contains(outline.points, v.position)) << v.position.transpose();
    }
  }
}

TEST(ExtractSkeletons, AnOutlineThatCrossesItselfHasATree) {
  const Skeleton skeleton = SkeletonOf(testing::Drawn({{0, 0}, {4, 3}, {4, 0}, {0, 2}}));
  EXPECT_TRUE(IsTree(skeleton));
}

TEST(ExtractSkeletons, ScalingAndMovingTheDrawingDoesTheSameToTheSkeleton) {
  const Outline leg = testing::Leg();
  Outline moved = leg;
  for (Vector2d& p : moved.points) p = 1e3 * p + Vector2d(5e4, -2e4);
  const Skeleton a = SkeletonOf(leg), b = SkeletonOf(moved);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_LT((1e3 * a.vertices[i].position + Vector2d(5e4, -2e4) - b.vertices[i].position).norm(),
              1);
    EXPECT_NEAR(1e3 * a.vertices[i].radius, b.vertices[i].radius, 1);
  }
}

TEST(ExtractSkeletons, AnAbuttingTailReachesIntoTheBodyByHalfItsWidth) {
  const testing::Drawing beast = testing::MakeBeast();
  const auto skeletons = ExtractSkeletons(beast.parts, beast.graph);
  ASSERT_TRUE(skeletons.ok());
  const auto tail = std::find_if(skeletons->begin(), skeletons->end(),
                                 [](const Skeleton& s) { return s.part == testing::kTail; });
  ASSERT_NE(tail, skeletons->end());
  double left = 10;
  for (const SkeletonVertex& v : tail->vertices) left = std::min(left, v.position.x() - v.radius);
  // The joint runs from x = 2.9 to 3.7; its chord is 0.9 wide and stands at an angle.
  EXPECT_LT(left, 3.0);
  const Outline extended = OutlineToFill(beast.parts, testing::kTail, testing::kBody);
  EXPECT_GT(SignedArea(extended.points),
            SignedArea(beast.parts.parts[testing::kTail].outline.points));
  for (const OutlineKind kind : extended.kinds) EXPECT_NE(kind, OutlineKind::kShared);
}

TEST(ExtractSkeletons, ATailOnAHaunchReachesThroughItIntoTheBody) {
  testing::Drawing drawing = OnlyBody(testing::Ellipse({0, 0}, 4, 2));
  drawing.Add(testing::Ellipse({3.2, 0}, 1.3, 1.3), PartRole::kForeground, 0);
  // From the haunch's outline at x = 4.5, half a unit right of the body's, outwards.
  Outline tail = testing::Drawn({{4.45, -0.4}, {6, -0.4}, {6, 0.4}, {4.45, 0.4}});
  for (std::size_t i = 0; i < tail.points.size(); ++i) {
    if ((tail.points[i] + tail.points[(i + 1) % 4]).x() < 9) tail.kinds[i] = OutlineKind::kShared;
  }
  const int index = drawing.Add(tail, PartRole::kSagittal, 0);
  double left = 10;
  for (const Vector2d& p : OutlineToFill(drawing.parts, index, 0).points)
    left = std::min(left, p.x());
  EXPECT_NEAR(left, 4 - 0.4, 0.05);
}

TEST(ExtractSkeletons, OnlyPartsThatAreBuiltHaveOne) {
  testing::Drawing beast = testing::MakeBeast();
  beast.Add(testing::Ellipse({-1, 3.2}, 0.4, 0.2), PartRole::kSagittal, testing::kFarLeg);
  const auto skeletons = ExtractSkeletons(beast.parts, beast.graph);
  ASSERT_TRUE(skeletons.ok());
  for (const Skeleton& s : *skeletons) EXPECT_LT(s.part, testing::kFarLeg);
  EXPECT_EQ(skeletons->size(), 6u);
  ASSERT_EQ(skeletons.diagnostics().size(), 1u);
  EXPECT_EQ(skeletons.diagnostics()[0].code, "part-not-built");
}

TEST(ExtractSkeletons, OutlinesWithoutAreaAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<Vector2d>& ring :
       std::vector<std::vector<Vector2d>>{{},
                                          {{1, 1}},
                                          {{0, 0}, {1, 1}},
                                          {{0, 0}, {1, 1}, {2, 2}},
                                          {{0, 0}, {1, 0}, {nan, 1}},
                                          {{5, 5}, {5, 5}, {5, 5}}}) {
    const testing::Drawing drawing = OnlyBody(testing::Drawn(ring));
    const auto skeletons = ExtractSkeletons(drawing.parts, drawing.graph);
    ASSERT_FALSE(skeletons.ok());
    EXPECT_EQ(skeletons.diagnostics()[0].code, "degenerate-outline");
    EXPECT_EQ(skeletons.diagnostics()[0].failure, FailureKind::kUnderstanding);
    EXPECT_TRUE(skeletons.diagnostics()[0].at->allFinite());
  }
}

TEST(ExtractSkeletons, ThreadsDoNotChangeTheResult) {
  const testing::Drawing beast = testing::MakeBeast();
  Execution one, many;
  one.threads = 1;
  many.threads = 4;
  const auto a = ExtractSkeletons(beast.parts, beast.graph, {}, one);
  const auto b = ExtractSkeletons(beast.parts, beast.graph, {}, many);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(*a, *b);
}

}  // namespace
}  // namespace lascaux

#include "skeleton/simplify_skeleton.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skeleton/index.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

Skeleton Path(const std::vector<SkeletonVertex>& vertices) {
  Skeleton path;
  path.vertices = vertices;
  for (int i = 0; i + 1 < static_cast<int>(vertices.size()); ++i) path.edges.push_back({i, i + 1});
  return path;
}

TEST(DistanceToCone, IsExactForCylindersConesAndNestedDiscs) {
  const SkeletonVertex a{{0, 0}, 1}, b{{4, 0}, 1}, small{{4, 0}, 0.5}, inner{{0.2, 0}, 0.1};
  EXPECT_NEAR(DistanceToCone(a, b, {2, 3}), 2, 1e-12);
  EXPECT_NEAR(DistanceToCone(a, b, {-3, 0}), 2, 1e-12);
  EXPECT_NEAR(DistanceToCone(a, b, {2, 0}), -1, 1e-12);
  EXPECT_NEAR(DistanceToCone(a, small, {6, 0}), 1.5, 1e-12);
  EXPECT_NEAR(DistanceToCone(a, inner, {2, 0}), 1, 1e-12);
  // The contact points of the tangent lie on the hull.
  const double sine = 0.5 / 4, cosine = std::sqrt(1 - sine * sine);
  EXPECT_NEAR(DistanceToCone(a, small, {sine, cosine}), 0, 1e-12);
  EXPECT_NEAR(DistanceToCone(a, small, {4 + 0.5 * sine, -0.5 * cosine}), 0, 1e-12);
}

TEST(Simplify, AStraightConeNeedsItsEndsAlone) {
  std::vector<SkeletonVertex> discs;
  for (int i = 0; i <= 100; ++i) discs.push_back({{0.1 * i, 0}, 1 + 0.005 * i});
  const Skeleton simple = Simplify(Path(discs), 0.1);
  ASSERT_EQ(simple.vertices.size(), 2u);
  EXPECT_EQ(simple.vertices[0], discs.front());
  EXPECT_EQ(simple.vertices[1], discs.back());
}

TEST(Simplify, MovesTheOutlineByNoMoreThanTheTolerance) {
  std::vector<SkeletonVertex> discs;
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.05 * i;
    discs.push_back({{t, std::sin(t)}, 1 + 0.3 * std::sin(2 * t)});
  }
  std::size_t before = discs.size();
  for (const double tolerance : {0.01, 0.05, 0.2}) {
    const Skeleton simple = Simplify(Path(discs), tolerance);
    EXPECT_LT(simple.vertices.size(), before);
    before = simple.vertices.size();
    for (const SkeletonVertex& disc : discs) {
      // A disc reaches as far out of the simplified hull as its circle does.
      double least = 10;
      for (const auto& [a, b] : simple.edges) {
        least = std::min(least, DistanceToCone(simple.vertices[Index(a)], simple.vertices[Index(b)],
                                               disc.position) +
                                    disc.radius);
      }
      EXPECT_LT(least, 1.5 * tolerance);
    }
  }
}

TEST(Simplify, StubsGoAndBranchesStay) {
  Skeleton tree = Path({{{-3, 0}, 1}, {{0, 0}, 1}, {{3, 0}, 1}});
  tree.vertices.push_back({{0, 0.3}, 0.72});
  tree.edges.push_back({1, 3});
  EXPECT_EQ(Simplify(tree, 0.1).vertices.size(), 2u);
  tree.vertices[3] = {{0, 2}, 0.5};
  EXPECT_EQ(Simplify(tree, 0.1).vertices.size(), 4u);
}

}  // namespace
}  // namespace lascaux

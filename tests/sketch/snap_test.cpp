#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "sketch/drawings.h"

namespace lascaux {
namespace {

using namespace testing;
using Eigen::Vector2d;

bool HasGap(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.code == "gap-closed"; });
}

const Points kSquare{{0, 0}, {100, 0}, {100, 100}, {0, 100}};

TEST(Snapping, EndNearALineIsAJunctionOnIt) {
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{0.3, 40}, {99.6, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 2);
  EXPECT_FALSE(HasGap(map.diagnostics()));
}

/// A square with six lines across it that begin and end so far from its sides.
Sketch Ladder(double left, double right) {
  Sketch ladder = SketchOf({Loop(kSquare)});
  for (int k = 1; k <= 6; ++k)
    ladder.strokes.push_back(Straight({{left, 14.0 * k}, {100 - right, 14.0 * k}}));
  return ladder;
}

TEST(Snapping, WhereMostEndsMissALineTheyAreMeantToMeetIt) {
  // 1.3 % of the diagonal, which is a suggestive curve's open end where others meet exactly.
  const auto by_hand = BuildPlanarMap(Ladder(1.84, 1.84)), exact = BuildPlanarMap(Ladder(0, 1.84));
  ASSERT_TRUE(by_hand && exact);
  EXPECT_EQ(Count(*by_hand, CycleKind::kBorder), 7);
  EXPECT_EQ(Count(*exact, CycleKind::kBorder), 1);
}

TEST(Snapping, EndsMayMissInAnyDirection) {
  // A box of four lines that meet in corners of two or three ends, cut in three by lines across.
  const std::vector<std::pair<Vector2d, Vector2d>> lines{
      {{0, 0}, {50, 0}},   {{50, 0}, {100, 0}}, {{100, 0}, {100, 60}}, {{100, 60}, {50, 60}},
      {{50, 60}, {0, 60}}, {{0, 60}, {0, 0}},   {{50, 0}, {50, 60}},   {{70, 0}, {70, 60}}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  for (int k = 0; k < 40; ++k) {
    const auto missed = [&](const Vector2d& p) -> Vector2d {
      const double a = angle(random);
      return p + Vector2d(std::cos(a), std::sin(a));
    };
    Sketch by_hand;
    for (const auto& [from, to] : lines)
      by_hand.strokes.push_back(Straight({missed(from), missed(to)}));
    const auto map = BuildPlanarMap(by_hand);
    ASSERT_TRUE(map) << k;
    EXPECT_EQ(Count(*map, CycleKind::kBorder), 3) << k;
  }
}

TEST(Snapping, EndsThatMeetInOnePlaceAreOneNode) {
  // Two by two they are nearer to each other than the pairs are.
  const auto map = BuildPlanarMap(SketchOf(
      {Loop(kSquare), Straight({{0, 40}, {49.9, 40}}), Straight({{49.9, 100}, {49.9, 40.1}}),
       Straight({{50.3, 0}, {50.3, 39.9}}), Straight({{100, 40}, {50.4, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 4);
}

TEST(Snapping, FringesAreNotDrawnIntoOnePoint) {
  // 25 hairs, each end 0.3 % of the diagonal from the next.
  Sketch fringes = SketchOf({Loop(kSquare)});
  for (int k = 0; k < 25; ++k)
    fringes.strokes.push_back(Straight({{40 + 0.4 * k, 30}, {40 + 0.4 * k, 60}}));
  const auto map = BuildPlanarMap(fringes);
  ASSERT_TRUE(map);
  for (const MapEdge& edge : map->edges) {
    const double lean = std::abs(edge.points.front().x() - edge.points.back().x());
    EXPECT_LE(edge.stroke > 0 ? lean : 0, 0.8);
  }
}

TEST(Snapping, EndsThatMeetBesideALineMeetOnIt) {
  const auto map = BuildPlanarMap(SketchOf(
      {Loop(kSquare), Straight({{0.1, 40}, {100, 20}}), Straight({{0.2, 40.1}, {100, 60}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 3);
}

TEST(Snapping, OvershootLeavesNoSpur) {
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{-0.5, 40}, {100.5, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 2);
  for (const MapNode& node : map->nodes) EXPECT_GE(node.outgoing.size(), 2u);
}

}  // namespace
}  // namespace lascaux

#include "lascaux/sketch/planar_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "sketch/drawings.h"

namespace lascaux {
namespace {

using namespace testing;
using Eigen::Vector2d;

double LargestArea(const PlanarMap& map) {
  double largest = 0;
  for (const MapCycle& cycle : map.cycles) largest = std::max(largest, cycle.area);
  return largest;
}

bool Has(const Diagnostics& diagnostics, const std::string& code) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [&](const Diagnostic& d) { return d.code == code; });
}

const Points kSquare{{0, 0}, {100, 0}, {100, 100}, {0, 100}};

TEST(PlanarMap, ClosedCurveIsOneBorderCycleOfItsArea) {
  const auto map = BuildPlanarMap(SketchOf({Circle({5, 7}, 10)}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 1);
  EXPECT_EQ(Count(*map, CycleKind::kOuter), 1);
  EXPECT_NEAR(LargestArea(*map), std::numbers::pi * 100, 0.1);
}

TEST(PlanarMap, LineAcrossCutsAFaceInTwo) {
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{0, 40}, {100, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 2);
  EXPECT_NEAR(LargestArea(*map), 6000, 1e-6);
}

TEST(PlanarMap, CrossingStrokesMeetInANodeOfFourEdges) {
  const auto map = BuildPlanarMap(
      SketchOf({Loop(kSquare), Straight({{0, 50}, {100, 50}}), Straight({{50, 0}, {50, 100}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 4);
  EXPECT_TRUE(std::any_of(map->nodes.begin(), map->nodes.end(),
                          [](const MapNode& n) { return n.outgoing.size() == 4; }));
}

TEST(PlanarMap, ClosedCurveInsideAnotherIsAnIslandOfIt) {
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Circle({30, 30}, 5)}));
  ASSERT_TRUE(map);
  ASSERT_EQ(Count(*map, CycleKind::kIsland), 1);
  for (const MapCycle& cycle : map->cycles) {
    if (cycle.kind != CycleKind::kIsland) continue;
    ASSERT_TRUE(cycle.inside);
    EXPECT_EQ(map->cycles[static_cast<std::size_t>(*cycle.inside)].kind, CycleKind::kBorder);
  }
}

TEST(PlanarMap, DotIsAnIslandOfThePensWidth) {
  Stroke dot;
  dot.pieces = {Line({30, 30}, {30, 30})};
  dot.is_dot = true;
  dot.width = 6;
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), dot}));
  ASSERT_TRUE(map);
  ASSERT_EQ(Count(*map, CycleKind::kIsland), 1);
  for (const MapCycle& cycle : map->cycles) {
    if (cycle.kind == CycleKind::kIsland) {
      EXPECT_NEAR(cycle.area, std::numbers::pi * 9, 0.2);
    }
  }
}

TEST(PlanarMap, OpenEndInsideAFaceIsNotBridged) {
  // 2 % of the diagonal from the right side: a gap there would be closed, a suggestive curve must
  // not be.
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{0, 40}, {97.2, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 1);
  EXPECT_TRUE(std::any_of(map->nodes.begin(), map->nodes.end(),
                          [](const MapNode& n) { return n.outgoing.size() == 1; }));
}

TEST(PlanarMap, SmallGapIsClosedWithAWarningAtItsPlace) {
  const auto map = BuildPlanarMap(
      SketchOf({Straight({{52, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}, {48.5, 0}})}));
  ASSERT_TRUE(map);
  EXPECT_NEAR(LargestArea(*map), 10000, 1e-3);
  ASSERT_TRUE(Has(map.diagnostics(), "gap-closed"));
  for (const Diagnostic& d : map.diagnostics()) {
    if (d.code != "gap-closed") continue;
    EXPECT_EQ(d.severity, Severity::kWarning);
    ASSERT_TRUE(d.at);
    EXPECT_NEAR(d.at->y(), 0, 1e-6);
    EXPECT_NEAR(d.at->x(), 50, 3);
  }
}

TEST(PlanarMap, SeveralWideGapsOfOneOutlineAreClosedTogether) {
  // Sides of a square, each 7 % of the diagonal from the next: no closure encloses anything alone.
  const auto map =
      BuildPlanarMap(SketchOf({Straight({{5, 0}, {95, 0}}), Straight({{105, 5}, {105, 95}}),
                               Straight({{95, 100}, {5, 100}}), Straight({{-5, 95}, {-5, 5}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(std::count_if(map.diagnostics().begin(), map.diagnostics().end(),
                          [](const Diagnostic& d) { return d.code == "gap-closed"; }),
            4);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 1);
  EXPECT_GT(LargestArea(*map), 10'500);
}

TEST(PlanarMap, WhereTheOutlineIsClosedNoWideGapIs) {
  // A tail of one line that hangs down beside the rump: its end is 4 % of the size from it.
  const auto map = BuildPlanarMap(
      SketchOf({Loop(kSquare), Straight({{100, 10}, {112, 15}, {108, 30}, {106, 80}})}));
  ASSERT_TRUE(map);
  EXPECT_FALSE(Has(map.diagnostics(), "gap-closed"));
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 1);
}

TEST(PlanarMap, WideGapOfAHeadIsClosedThoughABodyIsEnclosed) {
  // A third of the lines would stay outside; the head's end is 6 % of the size from the body.
  const auto map = BuildPlanarMap(
      SketchOf({Loop(kSquare), Straight({{0, 10}, {-80, 10}, {-80, 60}, {-12, 60}})}));
  ASSERT_TRUE(map);
  EXPECT_TRUE(Has(map.diagnostics(), "gap-closed"));
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 2);
}

TEST(PlanarMap, LegThatTouchesTheBodyAlmostClosesIt) {
  // Suggestive curves begin at both corners of the body beside it, so no end there is free.
  const auto map = BuildPlanarMap(
      SketchOf({Straight({{40, 100}, {0, 100}, {0, 0}, {100, 0}, {100, 100}, {60, 100}}),
                Straight({{40, 100}, {42, 60}}), Straight({{60, 100}, {58, 60}}),
                Loop({{40, 101.5}, {60, 101.5}, {58, 140}, {42, 140}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 2);
  EXPECT_NEAR(LargestArea(*map), 10'030, 10);
}

TEST(PlanarMap, LineMayCloseOntoItself) {
  // A long tail, the animal, and back up to the tail: the end points at its own line.
  const auto map = BuildPlanarMap(
      SketchOf({Straight({{-60, 60}, {0, 50}, {0, 0}, {100, 0}, {100, 100}, {0, 100}, {-4, 62}})}));
  ASSERT_TRUE(map);
  EXPECT_TRUE(Has(map.diagnostics(), "gap-closed"));
  EXPECT_GT(LargestArea(*map), 9'900);
}

int FreeEnds(const PlanarMap& map) {
  return static_cast<int>(std::count_if(map.nodes.begin(), map.nodes.end(),
                                        [](const MapNode& n) { return n.outgoing.size() == 1; }));
}

TEST(PlanarMap, PathThatIsFreeAtBothEndsMeetsTheLineThatItBeginsAt) {
  // 1.8 % of the diagonal below the upper side, straight down into the face.
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{40, 2.5}, {40, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_TRUE(Has(map.diagnostics(), "gap-closed"));
  EXPECT_EQ(FreeEnds(*map), 1);
  // An eye there is no such path.
  const auto eye = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{40, 2.5}, {40, 7}})}));
  ASSERT_TRUE(eye);
  EXPECT_FALSE(Has(eye.diagnostics(), "gap-closed"));
}

TEST(PlanarMap, EndThatStopsJustBeforeTheLineThatItPointsAtMeetsIt) {
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{0, 40}, {98.8, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 2);
  // The tips of a limb's two curves don't meet.
  const auto limb = BuildPlanarMap(SketchOf(
      {Loop(kSquare), Straight({{30, 100}, {49.4, 50}}), Straight({{70, 100}, {50.6, 50}})}));
  ASSERT_TRUE(limb);
  EXPECT_EQ(FreeEnds(*limb), 2);
}

TEST(PlanarMap, EndsInsideThatPointAtEachOtherAreOneLine) {
  // 2.1 % of the diagonal apart; a limb's curves that lean towards each other stay open.
  const auto line = BuildPlanarMap(
      SketchOf({Loop(kSquare), Straight({{0, 40}, {40, 41}}), Straight({{43, 41}, {100, 40}})}));
  const auto limb = BuildPlanarMap(
      SketchOf({Loop(kSquare), Straight({{30, 100}, {36, 70}}), Straight({{45, 100}, {39, 70}})}));
  ASSERT_TRUE(line && limb && Has(line.diagnostics(), "gap-closed"));
  EXPECT_EQ(Count(*line, CycleKind::kBorder), 2);
  EXPECT_EQ(FreeEnds(*limb), 2);
}

TEST(PlanarMap, OvershootBeyondTheSnapRadiusLeavesNoSpur) {
  const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{-1.4, 40}, {101.4, 40}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(FreeEnds(*map), 0);
}

TEST(PlanarMap, WideGapIsAnErrorThatSaysWhere) {
  const auto map = BuildPlanarMap(
      SketchOf({Straight({{60, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}, {40, 0}})}));
  ASSERT_FALSE(map);
  ASSERT_TRUE(Has(map.diagnostics(), "outline-open"));
  const Diagnostic& error = map.diagnostics().back();
  EXPECT_EQ(error.failure, FailureKind::kUnderstanding);
  ASSERT_TRUE(error.at);
  EXPECT_NEAR(error.at->y(), 0, 1e-6);
  EXPECT_NEAR(std::abs(error.at->x() - 50), 10, 1e-6);
}

TEST(PlanarMap, OutlineThatIsOpenInManyPlacesSaysHowManyAndWhereItIsWidest) {
  // Sides of a square whose corners are cut off far.
  const auto map =
      BuildPlanarMap(SketchOf({Straight({{25, 0}, {75, 0}}), Straight({{100, 25}, {100, 75}}),
                               Straight({{75, 100}, {25, 100}}), Straight({{0, 65}, {0, 25}})}));
  ASSERT_FALSE(map);
  const Diagnostic& error = map.diagnostics().back();
  EXPECT_EQ(error.code, "outline-open");
  EXPECT_NE(error.message.find("in 4 places"), std::string::npos) << error.message;
  ASSERT_TRUE(error.at);
  const bool at_widest =
      (*error.at - Vector2d(0, 65)).norm() < 1e-6 || (*error.at - Vector2d(25, 100)).norm() < 1e-6;
  EXPECT_TRUE(at_widest) << error.message;
}

TEST(PlanarMap, LineWithoutAnInsideHasAnOpenOutline) {
  const auto map = BuildPlanarMap(SketchOf({Straight({{0, 0}, {100, 5}})}));
  ASSERT_FALSE(map);
  EXPECT_TRUE(Has(map.diagnostics(), "outline-open"));
}

TEST(PlanarMap, SlitBetweenLinesSideBySideIsClosedIfNothingElseHoldsAnAnimal) {
  // A bag whose neck is 0.3 % of the diagonal wide and long, without an end near the neck.
  const auto map = BuildPlanarMap(SketchOf({Straight({{49.8, -60},
                                                      {49.8, -20},
                                                      {0, 0},
                                                      {0, 100},
                                                      {100, 100},
                                                      {100, 0},
                                                      {50.2, -20},
                                                      {80, -60}})}));
  ASSERT_TRUE(map);
  EXPECT_TRUE(Has(map.diagnostics(), "slit-closed"));
  EXPECT_GT(LargestArea(*map), 9000);
}

TEST(PlanarMap, SmallCellAtTheBorderIsMergedWithItsNeighbour) {
  const auto map =
      BuildPlanarMap(SketchOf({Loop(kSquare), Straight({{97, 100}, {97, 97}, {100, 97}})}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 1);
  EXPECT_TRUE(Has(map.diagnostics(), "cell-merged"));
  EXPECT_NEAR(LargestArea(*map), 10000, 1e-6);
}

TEST(PlanarMap, NoStrokesAreAnError) {
  const auto map = BuildPlanarMap({});
  ASSERT_FALSE(map);
  EXPECT_EQ(map.diagnostics().front().code, "no-strokes");
  EXPECT_EQ(map.diagnostics().front().failure, FailureKind::kInput);
}

TEST(PlanarMap, ScribbleIsRefused) {
  Sketch sketch;
  for (int i = 0; i < 480; ++i) {
    sketch.strokes.push_back(Straight({{i * 1.0, 0}, {i * 1.0, 480}}));
    sketch.strokes.push_back(Straight({{0, i * 1.0}, {480, i * 1.0}}));
  }
  const auto map = BuildPlanarMap(sketch);
  ASSERT_FALSE(map);
  EXPECT_TRUE(Has(map.diagnostics(), "too-tangled"));
}

TEST(PlanarMap, StrokesThatFloatInsideAreNoIslands) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(10, 90);
    const auto p = [&] { return Vector2d(at(random), at(random)); };
    const auto map = BuildPlanarMap(SketchOf({Loop(kSquare), Straight({p(), p(), p(), p()})}));
    ASSERT_TRUE(map);
    for (const MapCycle& cycle : map->cycles) {
      if (cycle.kind == CycleKind::kIsland) {
        EXPECT_GT(cycle.area, 1e-6) << "seed " << seed;
      }
    }
  }
}

TEST(PlanarMap, HatchingIsRefused) {
  Sketch sketch;
  for (int i = 0; i < 20'001; ++i) sketch.strokes.push_back(Straight({{i * 1.0, 0}, {i * 1.0, 3}}));
  const auto map = BuildPlanarMap(sketch);
  ASSERT_FALSE(map);
  EXPECT_TRUE(Has(map.diagnostics(), "too-many-strokes"));
}

TEST(PlanarMap, ThousandsOfStrokesTakeBoundedTime) {
  Sketch sketch = SketchOf({Loop({{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}})});
  for (int i = 0; i < 70; ++i) {
    for (int k = 0; k < 70; ++k) {
      sketch.strokes.push_back(
          Straight({{14.0 * i + 5, 14.0 * k + 5}, {14.0 * i + 11, 14.0 * k + 6}}));
    }
  }
  const auto map = BuildPlanarMap(sketch);
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 1);
}

/// Every half-edge in one cycle; V - E + F = 1 + C over the bounded faces; areas of a component add
/// up to nothing.
void ExpectConsistent(const PlanarMap& map) {
  std::vector<int> seen(map.next.size(), 0);
  double area = 0;
  int outsides = 0;
  for (std::size_t c = 0; c < map.cycles.size(); ++c) {
    for (const int h : map.cycles[c].half_edges) {
      ++seen[static_cast<std::size_t>(h)];
      EXPECT_EQ(map.cycle[static_cast<std::size_t>(h)], static_cast<int>(c));
      EXPECT_EQ(map.Target(h), map.Origin(map.next[static_cast<std::size_t>(h)]));
    }
    area += map.cycles[c].area;
    const CycleKind kind = map.cycles[c].kind;
    outsides += kind == CycleKind::kOuter || kind == CycleKind::kHole ? 1 : 0;
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_NEAR(area, 0, 1e-6 * map.diagonal * map.diagonal);
  const int bounded = static_cast<int>(map.cycles.size()) - outsides;
  EXPECT_EQ(static_cast<int>(map.nodes.size()) - static_cast<int>(map.edges.size()) + bounded,
            outsides);
}

TEST(PlanarMap, RandomStrokesGiveAConsistentMap) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(0, 100);
    Sketch sketch = SketchOf({Loop({{-5, -5}, {105, -5}, {105, 105}, {-5, 105}})});
    for (int k = 0; k < 12; ++k) {
      const auto p = [&] { return Vector2d(at(random), at(random)); };
      Stroke stroke;
      stroke.pieces = {{{p(), p(), p(), p()}}};
      stroke.width = 0.5;
      sketch.strokes.push_back(stroke);
    }
    const auto map = BuildPlanarMap(sketch);
    ASSERT_TRUE(map);
    ExpectConsistent(*map);
  }
}

TEST(PlanarMap, StructureDoesNotDependOnScalePlaceOrMirroring) {
  const auto original = BuildPlanarMap(Quadruped());
  ASSERT_TRUE(original);
  for (const Sketch& other : {Moved(Quadruped(), 1e-4, {3, -2}),
                              Moved(Quadruped(), 1e5, {-7e6, 1e6}), Mirrored(Quadruped())}) {
    const auto map = BuildPlanarMap(other);
    ASSERT_TRUE(map);
    EXPECT_EQ(map->nodes.size(), original->nodes.size());
    EXPECT_EQ(map->edges.size(), original->edges.size());
    for (const CycleKind kind :
         {CycleKind::kBorder, CycleKind::kIsland, CycleKind::kOther, CycleKind::kOuter}) {
      EXPECT_EQ(Count(*map, kind), Count(*original, kind));
    }
  }
}

TEST(PlanarMap, ManyPointsTakeBoundedTime) {
  Points wobble;
  for (int i = 0; i < 100'000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100'000,
                 radius = 100 + 0.05 * std::sin(900 * angle);
    wobble.push_back(radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  const auto map = BuildPlanarMap(SketchOf({Loop(wobble)}));
  ASSERT_TRUE(map);
  EXPECT_EQ(Count(*map, CycleKind::kBorder), 1);
}

}  // namespace
}  // namespace lascaux

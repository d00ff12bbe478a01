#include "lascaux/volume/prepare_print.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/extract_mesh.h"
#include "lascaux/volume/level_set.h"
#include "volume/fields.h"
#include "volume/shapes.h"
#include "volume/thin_shapes.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using openvdb::FloatGrid;
using testing::kThin;
using testing::kVoxel;
using testing::OnThreads;

constexpr double kLimit = 0.8;

struct Solid {
  NarrowBand band;
  Mesh mesh;
};

Solid SolidOf(const FloatGrid::Ptr& grid) {
  NarrowBand band = ToNarrowBand(*grid);
  Mesh mesh = *ExtractMesh(band);
  return {std::move(band), std::move(mesh)};
}

ThinPlaces ThinPlacesOf(const FloatGrid::Ptr& grid) {
  const Mesh mesh = SolidOf(grid).mesh;
  return TellThinPlaces(mesh, FindThinWalls(mesh, kLimit), kLimit);
}

PrintOptions MinWall(double wall) {
  PrintOptions options;
  options.min_wall = wall;
  return options;
}

PrintOptions HollowBy(double wall) {
  PrintOptions options;
  options.hollow = wall;
  return options;
}

using Place = std::array<float, 3>;

Place PlaceOf(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

std::set<Place> PlacesOf(const Mesh& mesh) {
  std::set<Place> places;
  for (const Eigen::Vector3f& v : mesh.vertices) places.insert(PlaceOf(v));
  return places;
}

bool IsNear(const std::vector<Wall>& walls, const Eigen::Vector3f& v, double distance) {
  return std::any_of(walls.begin(), walls.end(), [&](const Wall& wall) {
    return (wall.middle - v.cast<double>()).norm() < distance;
  });
}

double Volume(const Mesh& mesh) { return CheckMesh(mesh).volume; }

TEST(TellThinPlaces, FindsWhatBreaks) {
  for (const auto& grid : {testing::Neck(), testing::Leg(), testing::Membrane()}) {
    const ThinPlaces places = ThinPlacesOf(grid);
    ASSERT_TRUE(places.wall);
    EXPECT_NEAR(places.wall->thickness, kThin, 0.7 * kVoxel);
  }
  EXPECT_LT(std::abs(ThinPlacesOf(testing::Neck()).wall->middle.x()), 6);
  EXPECT_LT(ThinPlacesOf(testing::Leg()).wall->middle.y(), -8);
  EXPECT_LT(ThinPlacesOf(testing::Membrane()).wall->middle.norm(), 8.1);
}

TEST(TellThinPlaces, IsNotAlarmedByAPoint) {
  const ThinPlaces places = ThinPlacesOf(testing::Spike());
  EXPECT_FALSE(places.wall);
  ASSERT_TRUE(places.tip);
  EXPECT_GT(places.tip->middle.x(), 8);
}

TEST(PreparePrint, ThickensWhatBreaksAndLeavesTheRest) {
  constexpr double kWanted = 1.2;
  for (const auto& grid : {testing::Neck(), testing::Leg(), testing::Membrane()}) {
    const Solid solid = SolidOf(grid);
    const auto prepared = PreparePrint(solid.band, solid.mesh, MinWall(kWanted));
    ASSERT_TRUE(prepared.ok());
    EXPECT_FALSE(prepared->changes.thickened.empty());
    EXPECT_TRUE(prepared->changes.still_thin.empty());
    const Mesh mesh = *ExtractMesh(prepared->band);
    EXPECT_TRUE(MeshDefects(CheckMesh(mesh)).empty());
    const auto wall = SmallestWall(mesh);
    ASSERT_TRUE(wall);
    EXPECT_GT(wall->thickness, kWanted - 0.02 * kVoxel);
    // What was 0.3 mm off the middle is 0.6 off: never further than balls of half a voxel more.
    EXPECT_LT(Volume(mesh), Volume(solid.mesh) * (1 + 3 * (kWanted - kThin) / kThin));
    const std::set<Place> places = PlacesOf(mesh);
    int far = 0;
    for (const Eigen::Vector3f& v : solid.mesh.vertices) {
      if (IsNear(prepared->changes.thickened, v, 3 * kWanted)) continue;
      ++far;
      ASSERT_TRUE(places.contains(PlaceOf(v)));
    }
    EXPECT_GT(far, 0);
  }
}

TEST(PreparePrint, HollowsToTheWallAskedFor) {
  const auto grid = testing::LevelSetOf([](const Vector3d& p) { return p.norm() - 12; },
                                        {Vector3d::Constant(-12), Vector3d::Constant(12)}, 0.5);
  const Solid solid = SolidOf(grid);
  const auto prepared = PreparePrint(solid.band, solid.mesh, HollowBy(2));
  ASSERT_TRUE(prepared.ok());
  ASSERT_TRUE(prepared->changes.cavity);
  const Cavity& cavity = *prepared->changes.cavity;
  EXPECT_NEAR(cavity.saved, std::pow(10.0 / 12, 3), 0.01);
  EXPECT_NEAR(cavity.opening.y(), -12, 1.5);
  const Mesh mesh = *ExtractMesh(prepared->band);
  const MeshFacts facts = CheckMesh(mesh);
  EXPECT_TRUE(MeshDefects(facts).empty());
  const auto wall = SmallestWall(mesh);
  ASSERT_TRUE(wall);
  EXPECT_GT(wall->thickness, 2 - 0.5 * 0.5);  // at the rim of the drain; elsewhere 1.99
}

TEST(PreparePrint, DrillsNoDrainThroughALegThatIsTooThinForIt) {
  // The lowest wide place is the leg's end; a drain there would leave walls of 0.5 mm.
  const auto grid = testing::LevelSetOf(
      [](const Vector3d& p) {
        const double leg = std::max(std::hypot(p.x() - 6, p.z()) - 2.5, std::abs(p.y() + 12) - 14);
        return std::min(p.norm() - 12, leg);
      },
      {Vector3d(-12, -26, -12), Vector3d(12, 12, 12)}, 0.5);
  const Solid solid = SolidOf(grid);
  const auto prepared = PreparePrint(solid.band, solid.mesh, HollowBy(2));
  ASSERT_TRUE(prepared.ok());
  ASSERT_TRUE(prepared->changes.cavity);
  EXPECT_LT(prepared->changes.cavity->opening.x(), 3);
  const auto wall = SmallestWall(*ExtractMesh(prepared->band));
  ASSERT_TRUE(wall);
  EXPECT_GT(wall->thickness, 1);
}

TEST(PreparePrint, IsTheSameForAnyNumberOfThreadsAndKeepsTheFieldsVertices) {
  const Field field = testing::AnimalField();
  const NarrowBand band = *RasteriseBand(field, {.voxel_size = 0.02});
  const Mesh mesh = *ExtractMesh(band, field);
  PrintOptions options = MinWall(0.3);
  options.base = Base::kWhenItFalls;
  const auto one = PreparePrint(band, mesh, options, OnThreads(1));
  const auto many = PreparePrint(band, mesh, options, OnThreads(7));
  ASSERT_TRUE(one.ok() && many.ok());
  const Mesh printed = *ExtractMesh(one->band, field, one->unchanged);
  EXPECT_EQ(printed, *ExtractMesh(many->band, field, many->unchanged));
  EXPECT_NE(printed, mesh);
  const std::set<Place> places = PlacesOf(printed);
  // Legs are thinner than 0.3; nothing changes above the body's middle.
  for (const Eigen::Vector3f& v : mesh.vertices) {
    if (v.y() > 0.2F) {
      ASSERT_TRUE(places.contains(PlaceOf(v)));
    }
  }
}

TEST(PreparePrint, RefusesWallsThatTheVoxelsCannotShow) {
  const Solid solid = SolidOf(testing::Leg());
  for (const PrintOptions& options : {MinWall(1.9 * kVoxel), HollowBy(1.9 * kVoxel)}) {
    const auto prepared = PreparePrint(solid.band, solid.mesh, options);
    ASSERT_FALSE(prepared.ok());
    EXPECT_EQ(prepared.diagnostics().back().code, "print-too-coarse");
  }
}

}  // namespace
}  // namespace lascaux

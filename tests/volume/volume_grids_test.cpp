#include "lascaux/volume/volume_grids.h"

#include <gtest/gtest.h>
#include <openvdb/tools/Diagnostics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lascaux/volume/level_set.h"
#include "lascaux/volume/part_of_points.h"
#include "volume/fields.h"

namespace lascaux {
namespace {

using Grids = std::vector<openvdb::GridBase::ConstPtr>;
using testing::AnimalField;
using testing::RandomField;

constexpr double kVoxel = 0.04;
constexpr double kLift = 1.3;

/// A field with its level set, lifted as models are.
struct Animal {
  explicit Animal(Field f) : field(std::move(f)) {
    Diagnostics log;
    band = RasteriseBand(field, {.voxel_size = kVoxel}).MoveInto(log).value();
    band.origin.y() += kLift;
    for (std::size_t p = 0; p < field.parts.size(); ++p)
      parts.push_back({"limb-" + std::to_string(p), PartColor(static_cast<int>(p))});
  }

  ModelVolume Volume(Companions companions, UpAxis up = UpAxis::kY) const {
    return {band, field, parts, kLift, companions, up};
  }

  Field field;
  NarrowBand band;
  std::vector<MeshPart> parts;
};

Grids GridsOf(const ModelVolume& volume, const Execution& execution = {}) {
  const auto grids = VolumeGrids(volume, execution);
  EXPECT_TRUE(grids.ok());
  return grids.ok() ? *grids : Grids{};
}

openvdb::FloatGrid::ConstPtr Floats(const openvdb::GridBase::ConstPtr& grid) {
  return openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid);
}

openvdb::FloatGrid::ConstPtr Find(const Grids& grids, const std::string& name) {
  const auto found = std::find_if(grids.begin(), grids.end(),
                                  [&](const auto& grid) { return grid->getName() == name; });
  EXPECT_NE(found, grids.end()) << name;
  return found == grids.end() ? nullptr : Floats(*found);
}

TEST(TurnedZUp, EveryVoxelAndTileIsWhereItWas) {
  for (const Field& field : {AnimalField(), RandomField(3)}) {
    const Animal animal(field);
    const auto before = ToLevelSet(animal.band), after = ToLevelSet(TurnedZUp(animal.band));
    EXPECT_EQ(before->activeVoxelCount(), after->activeVoxelCount());
    EXPECT_EQ(openvdb::tools::checkLevelSet(*after, 8), "");
    const auto values = after->getConstAccessor();
    const openvdb::CoordBBox box = before->evalActiveVoxelBoundingBox();
    const auto was = before->getConstAccessor();
    for (auto c = box.begin(); c; ++c) {
      const openvdb::Vec3d p = before->indexToWorld(*c);
      const openvdb::Vec3d place = after->worldToIndex({p.x(), -p.z(), p.y()});
      const openvdb::Coord voxel = openvdb::Coord::round(place);
      ASSERT_NEAR((place - voxel.asVec3d()).length(), 0, 1e-9);
      ASSERT_EQ(values.getValue(voxel), was.getValue(*c)) << p;
      ASSERT_EQ(values.isValueOn(voxel), was.isValueOn(*c)) << p;
    }
  }
}

TEST(VolumeGrids, TheSurfaceComesFirstAndAllShareItsVoxels) {
  const Animal animal(AnimalField());
  EXPECT_EQ(GridsOf(animal.Volume({})).size(), 1U);
  for (const UpAxis up : {UpAxis::kY, UpAxis::kZ}) {
    const Grids grids = GridsOf(animal.Volume({.parts = true, .fog = true, .color = true}, up));
    std::vector<std::string> names;
    for (const auto& grid : grids) {
      names.push_back(grid->getName());
      EXPECT_TRUE(grid->transform() == grids[0]->transform()) << grid->getName();
    }
    EXPECT_EQ(names, (std::vector<std::string>{"surface", "density", "Cd", "part", "part_limb_0",
                                               "part_limb_1", "part_limb_2", "part_limb_3",
                                               "part_limb_4", "part_limb_5"}));
  }
}

TEST(VolumeGrids, PartsAreLevelSetsWithinTheSurfaceAndMakeItUpButForTheBlends) {
  const Animal animal(AnimalField());
  const Grids grids = GridsOf(animal.Volume({.parts = true}));
  const openvdb::FloatGrid& surface = *Floats(grids[0]);
  for (std::size_t g = 1; g < grids.size(); ++g) {
    const openvdb::FloatGrid& part = *Floats(grids[g]);
    EXPECT_EQ(openvdb::tools::checkLevelSet(part, 8), "") << part.getName();
    const auto whole = surface.getConstAccessor();
    for (auto value = part.cbeginValueOn(); value; ++value)  // its outside is not further in
      ASSERT_LE(std::min(0.0F, whole.getValue(value.getCoord())),
                std::min(0.0F, *value) + 0.05F * static_cast<float>(kVoxel));
  }
  // The paws' tips, far from the body, are the limbs' alone: the same distances.
  const auto whole = surface.getConstAccessor();
  int compared = 0;
  for (auto value = Find(grids, "part_limb_2")->cbeginValueOn(); value; ++value) {
    if (surface.indexToWorld(value.getCoord()).y() - kLift > -1) continue;
    EXPECT_NEAR(whole.getValue(value.getCoord()), *value, 0.01 * kVoxel);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(VolumeGrids, FogIsOneInsideAndFallsOverTheBand) {
  const Animal animal(AnimalField());
  const Grids grids = GridsOf(animal.Volume({.fog = true}));
  const openvdb::FloatGrid& surface = *Floats(grids[0]);
  const openvdb::FloatGrid& fog = *Floats(grids[1]);
  EXPECT_EQ(openvdb::tools::checkFogVolume(fog), "");
  const auto density = fog.getConstAccessor();
  const openvdb::CoordBBox box = surface.evalActiveVoxelBoundingBox();
  const auto distance = surface.getConstAccessor();
  for (auto c = box.begin(); c; ++c) {
    const float expected = std::clamp(-distance.getValue(*c) / surface.background(), 0.0F, 1.0F);
    ASSERT_NEAR(density.getValue(*c), expected, 1e-6) << *c;
    ASSERT_EQ(density.isValueOn(*c), expected > 0) << *c;
  }
}

TEST(VolumeGrids, EachVoxelHasTheColourAndTheNumberOfItsPart) {
  const Animal animal(AnimalField());
  for (const UpAxis up : {UpAxis::kY, UpAxis::kZ}) {
    const Grids grids = GridsOf(animal.Volume({.color = true}, up));
    const auto& color = *openvdb::gridConstPtrCast<openvdb::Vec3SGrid>(grids[1]);
    const openvdb::FloatGrid& index = *Floats(grids[2]);
    EXPECT_EQ(index.background(), -1);
    std::vector<int> found(animal.parts.size(), 0);
    std::vector<Eigen::Vector3f> points;
    const auto colors = color.getConstAccessor();
    const auto indices = index.getConstAccessor();
    std::vector<std::size_t> given;
    for (auto value = Floats(grids[0])->cbeginValueOn(); value; ++value) {
      const auto part = static_cast<std::size_t>(indices.getValue(value.getCoord()));
      ASSERT_LT(part, found.size());
      ++found[part];
      const Srgb8& srgb = animal.parts[part].color;
      const openvdb::Vec3f expected(LinearFromSrgb(srgb[0]), LinearFromSrgb(srgb[1]),
                                    LinearFromSrgb(srgb[2]));
      ASSERT_EQ(colors.getValue(value.getCoord()), expected);
      const openvdb::Vec3d p = color.indexToWorld(value.getCoord());
      points.push_back(ToModelAxes({p.x(), p.y(), p.z()}, up).cast<float>());
      given.push_back(part);
    }
    const auto truth = PartOfPoints(animal.field, points, {0, -kLift, 0});
    for (std::size_t i = 0; i < truth.size(); ++i)
      ASSERT_EQ(given[i], truth[i] == kNoPart ? 0 : truth[i]) << points[i].transpose();
    EXPECT_GT(*std::min_element(found.begin(), found.end()), 100);
    // Deep inside, where the band does not reach, too.
    const openvdb::Vec3d middle =
        up == UpAxis::kY ? openvdb::Vec3d(0, kLift, 0) : openvdb::Vec3d(0, 0, kLift);
    const openvdb::Coord center = openvdb::Coord::round(index.worldToIndex(middle));
    EXPECT_EQ(indices.getValue(center), 0);
    EXPECT_TRUE(colors.isValueOn(center));
  }
}

TEST(VolumeGrids, NamesAreOfLettersAndNoTwoAreTheSame) {
  Animal animal(AnimalField());
  animal.parts[1].name = "Schwanz Nr. 1\xc3\xa4";
  animal.parts[2].name = "a-b";
  animal.parts[3].name = "a_b";
  const Grids grids = GridsOf(animal.Volume({.parts = true}));
  EXPECT_EQ(grids[2]->getName(), "part_Schwanz_Nr__1__");
  EXPECT_EQ(grids[3]->getName(), "part_a_b");
  EXPECT_EQ(grids[4]->getName(), "part_a_b_");
}

TEST(VolumeGrids, APartThinnerThanTheVoxelsIsANote) {
  Field field = AnimalField();
  FieldPart hair;
  hair.chains.push_back({{{{0.3, 2, 0.33}, {0.31, 2.5, 0.33}, 1e-4, 1e-4}}, {}});
  field.parts.push_back(hair);
  const Animal animal(field);
  const auto grids = VolumeGrids(animal.Volume({.parts = true}));
  ASSERT_TRUE(grids.ok());
  EXPECT_EQ(grids->size(), 7U);
  ASSERT_EQ(grids.diagnostics().size(), 1U);
  EXPECT_EQ(grids.diagnostics()[0].code, "part-not-in-volume");
  EXPECT_NE(grids.diagnostics()[0].message.find("limb-6"), std::string::npos);
}

}  // namespace
}  // namespace lascaux

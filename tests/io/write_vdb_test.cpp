#include "lascaux/io/write_vdb.h"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "io/samples.h"
#include "io/temporary_folder.h"

namespace lascaux {
namespace {

struct VdbFile {
  openvdb::MetaMap::Ptr metadata;
  openvdb::FloatGrid::Ptr grid;
};

VdbFile Read(const std::filesystem::path& path) {
  openvdb::io::File file(path.string());
  file.open(/*delayLoad=*/false);
  return {file.getMetadata(), openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"))};
}

TEST(WriteVdb, ALevelSetIsOneAfterScaling) {
  const TemporaryFolder folder;
  // Sizes whose triple is rounded up, down and not at all.
  for (const double voxel_size : {0.390625, 0.1 + 0.2, 1.0 / 3, 0.7, 0.9999}) {
    for (const Unit unit : {Unit::kMillimetre, Unit::kCentimetre, Unit::kMetre}) {
      const auto grid = SampleLevelSet(voxel_size);
      ASSERT_TRUE(WriteVdb(folder / "a.vdb", *grid, {.unit = unit}).empty());
      const VdbFile file = Read(folder / "a.vdb");
      EXPECT_EQ(openvdb::tools::checkLevelSet(*file.grid), "") << voxel_size << Name(unit);
      EXPECT_EQ(file.grid->getGridClass(), openvdb::GRID_LEVEL_SET);
      EXPECT_NEAR(file.grid->voxelSize().x(), grid->voxelSize().x() * PerMillimetre(unit), 1e-12);
      EXPECT_EQ(file.grid->activeVoxelCount(), grid->activeVoxelCount());
    }
  }
}

TEST(WriteVdb, EveryDistanceAndPlaceIsScaled) {
  const TemporaryFolder folder;
  const auto grid = SampleLevelSet(0.5);
  ASSERT_TRUE(WriteVdb(folder / "a.vdb", *grid, {.unit = Unit::kMetre}).empty());
  const VdbFile file = Read(folder / "a.vdb");
  const auto scaled = file.grid->getConstAccessor();
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    EXPECT_NEAR(scaled.getValue(value.getCoord()), 0.001 * *value, 1e-9);
  }
  const openvdb::Coord center = openvdb::Coord::round(grid->worldToIndex({5, 20, -3}));
  EXPECT_EQ(scaled.getValue(center), -file.grid->background());
  const openvdb::Vec3d place = file.grid->indexToWorld(openvdb::Vec3d(1, 2, 3));
  EXPECT_TRUE(place.eq(0.001 * grid->indexToWorld(openvdb::Vec3d(1, 2, 3)), 1e-12));
  EXPECT_FLOAT_EQ(grid->background(), 1.5F);  // the input is as it was
}

TEST(WriteVdb, MetadataTellsUnitsAxesAndStatistics) {
  const TemporaryFolder folder;
  const auto grid = SampleLevelSet(0.5);
  const WriteVdbOptions options{.unit = Unit::kCentimetre, .metadata = {{"creator", "lascaux 1"}}};
  ASSERT_TRUE(WriteVdb(folder / "a.vdb", *grid, options).empty());
  const VdbFile file = Read(folder / "a.vdb");
  EXPECT_EQ(file.metadata->metaValue<std::string>("units"), "cm");
  EXPECT_EQ(file.metadata->metaValue<std::string>("up_axis"), "Y");
  EXPECT_EQ(file.metadata->metaValue<std::string>("creator"), "lascaux 1");
  EXPECT_GT(file.grid->metaValue<openvdb::Int64>("file_mem_bytes"), 100000);
  EXPECT_EQ(file.grid->metaValue<openvdb::Int64>("file_voxel_count"),
            static_cast<openvdb::Int64>(grid->activeVoxelCount()));
}

TEST(WriteVdb, TheSameGridGivesTheSameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  std::string first;
  for (const int threads : {1, 2, 5}) {
    Execution execution;
    execution.threads = threads;
    ASSERT_TRUE(WriteVdb(folder / "a.vdb", *SampleLevelSet(0.5), {}, execution).empty());
    const std::string bytes = Contents(folder / "a.vdb");
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads;
  }
}

TEST(WriteVdb, AnotherContentHasAnotherId) {
  const TemporaryFolder folder;
  const auto id = [&](const WriteVdbOptions& options) {
    EXPECT_TRUE(WriteVdb(folder / "a.vdb", *SampleLevelSet(1), options).empty());
    openvdb::io::File file((folder / "a.vdb").string());
    file.open();
    return file.getUniqueTag();
  };
  EXPECT_EQ(id({}), id({}));
  EXPECT_NE(id({}), id({.metadata = {{"creator", "another"}}}));
  EXPECT_EQ(id({}).size(), 36U);
}

TEST(WriteVdb, VoxelsThatOpenVdbRefusesAreAnError) {
  const TemporaryFolder folder;
  openvdb::initialize();
  const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(0.0144);
  const Diagnostics diagnostics = WriteVdb(folder / "a.vdb", *grid, {.unit = Unit::kMetre});
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].code, "voxel-too-small");
  EXPECT_EQ(diagnostics[0].failure, FailureKind::kOutput);
  EXPECT_TRUE(folder.Names().empty());
  EXPECT_TRUE(WriteVdb(folder / "a.vdb", *grid, {.unit = Unit::kMillimetre}).empty());
  const auto larger = openvdb::createLevelSet<openvdb::FloatGrid>(0.0145);
  EXPECT_TRUE(WriteVdb(folder / "a.vdb", *larger, {.unit = Unit::kMetre}).empty());
}

TEST(WriteVdb, HalfFloatsAreALevelSetStillWithElevenBits) {
  const TemporaryFolder folder;
  // The last are the smallest voxels in metres, and the largest of which a half holds three.
  for (const double voxel_size : {0.390625, 0.1 + 0.2, 1.0 / 3, 0.7, 0.0145, 21834.0}) {
    const auto grid = SampleLevelSet(0.5);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel_size));
    grid->transform().postTranslate({5 * voxel_size, 0, 0});
    for (auto value = grid->beginValueOn(); value; ++value)
      value.setValue(static_cast<float>(*value * voxel_size / 0.5));
    openvdb::tools::changeBackground(grid->tree(), static_cast<float>(3 * voxel_size));
    const Unit unit = voxel_size > 1 ? Unit::kMillimetre : Unit::kMetre;
    ASSERT_TRUE(
        WriteVdb(folder / "a.vdb", *grid, {.unit = unit, .floats = VdbFloats::kHalf}).empty());
    const VdbFile file = Read(folder / "a.vdb");
    EXPECT_TRUE(file.grid->saveFloatAsHalf());
    EXPECT_EQ(openvdb::tools::checkLevelSet(*file.grid, 8), "") << voxel_size;
    const auto halves = file.grid->getConstAccessor();
    const double to_voxels = 1 / (voxel_size * PerMillimetre(unit));
    for (auto value = grid->cbeginValueOn(); value; ++value) {
      const float half = halves.getValue(value.getCoord());
      // 2^-24 is the step of the smallest halves.
      const double expected = *value / voxel_size;
      const double step = std::max(std::abs(expected) / 2048, std::ldexp(1.0, -25) * to_voxels);
      EXPECT_NEAR(half * to_voxels, expected, 1.01 * step);
      EXPECT_EQ(half < 0, *value < 0);
    }
  }
}

TEST(WriteVdb, VoxelsThatHalfFloatsCannotHoldAreAnError) {
  const TemporaryFolder folder;
  openvdb::initialize();
  const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(21835);
  const WriteVdbOptions options{.unit = Unit::kMillimetre, .floats = VdbFloats::kHalf};
  const Diagnostics diagnostics = WriteVdb(folder / "a.vdb", *grid, options);
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].code, "voxel-too-large");
  EXPECT_TRUE(folder.Names().empty());
  EXPECT_TRUE(WriteVdb(folder / "a.vdb", *grid, {.floats = VdbFloats::kHalf}).empty());
}

TEST(WriteVdb, CompanionsFollowTheSurfaceAndAStreamReadsThem) {
  const TemporaryFolder folder;
  const auto grid = SampleLevelSet(0.5);
  const auto fog = grid->deepCopy();
  openvdb::tools::sdfToFogVolume(*fog);
  fog->setName("density");
  const auto colors = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.5F, 0.25F, 0));
  colors->setTransform(grid->transform().copy());
  colors->setName("Cd");
  colors->tree().setValueOn({1, 2, 3}, {0.1F, 0.2F, 0.3F});
  ASSERT_TRUE(WriteVdb(folder / "a.vdb", {grid, fog, colors}, {.up = UpAxis::kZ}).empty());
  std::ifstream file(folder / "a.vdb", std::ios::binary);
  openvdb::io::Stream stream(file);
  EXPECT_EQ(stream.getMetadata()->metaValue<std::string>("up_axis"), "Z");
  const openvdb::GridPtrVec grids = *stream.getGrids();
  ASSERT_EQ(grids.size(), 3U);
  // OpenVDB's readers sort grids by name, whatever their order in the file.
  EXPECT_EQ(grids[0]->getName(), "Cd");
  EXPECT_EQ(grids[1]->getName(), "density");
  EXPECT_EQ(grids[2]->getName(), "surface");
  const std::string bytes = Contents(folder / "a.vdb");
  EXPECT_LT(bytes.find("surface"), bytes.find("density"));
  EXPECT_LT(bytes.find("density"), bytes.find("Tree_vec3s"));
  for (const auto& each : grids) EXPECT_NEAR(each->voxelSize().x(), 0.0005, 1e-12);
  // Distances are scaled; densities and colours are not.
  const auto& read = *openvdb::gridPtrCast<openvdb::FloatGrid>(grids[1]);
  EXPECT_EQ(openvdb::tools::checkFogVolume(read), "");
  EXPECT_EQ(read.activeVoxelCount(), fog->activeVoxelCount());
  EXPECT_EQ(openvdb::gridPtrCast<openvdb::Vec3SGrid>(grids[0])->tree().getValue({1, 2, 3}),
            openvdb::Vec3f(0.1F, 0.2F, 0.3F));
}

TEST(WriteVdb, AFullDiskIsAnError) {
  const Diagnostics diagnostics = WriteVdb("/dev/full", *SampleLevelSet(1));
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].code, "cannot-write");
}

}  // namespace
}  // namespace lascaux

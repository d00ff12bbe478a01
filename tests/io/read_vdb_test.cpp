#include "lascaux/io/read_vdb.h"

#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "io/samples.h"

namespace lascaux {
namespace {

std::string BytesOf(const openvdb::GridPtrVec& grids, const openvdb::MetaMap& metadata = {}) {
  std::ostringstream stream(std::ios::binary);
  openvdb::io::Stream(stream).write(grids, metadata);
  return std::move(stream).str();
}

openvdb::FloatGrid::Ptr Named(const openvdb::FloatGrid::Ptr& grid, const std::string& name) {
  grid->setName(name);
  return grid;
}

/// The code of the error that reading `grid` leads to.
std::string ErrorOf(const openvdb::FloatGrid::Ptr& grid) {
  const auto model = ReadVdb(BytesOf({grid}));
  return model ? "none" : model.diagnostics()[0].code;
}

TEST(ReadVdb, ReadsTheSurfaceWhereverItStands) {
  const auto first = Named(SampleLevelSet(2), "part_torso");
  const auto fog = openvdb::FloatGrid::create();
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  const auto bytes = BytesOf({fog, openvdb::Int32Grid::create(), first,
                              Named(SampleLevelSet(1), "surface"), openvdb::Vec3SGrid::create()});
  const auto model = ReadVdb(bytes);
  ASSERT_TRUE(model.ok()) << model.diagnostics()[0].message;
  EXPECT_EQ(model->surface->getName(), "surface");
  EXPECT_EQ(model->surface->activeVoxelCount(), SampleLevelSet(1)->activeVoxelCount());
  EXPECT_EQ(model->surface->tree().getValue({5, 40, -3}), 0);
  EXPECT_EQ(ReadVdb(bytes, {.grid = "part_torso"})->surface->voxelSize().x(), 2);
  EXPECT_EQ(ReadVdb(BytesOf({fog, first}))->surface->getName(), "part_torso");
}

TEST(ReadVdb, TurnsFilesWithZUp) {
  openvdb::MetaMap metadata;
  metadata.insertMeta("up_axis", openvdb::StringMetadata("Z"));
  const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      20.F, openvdb::Vec3f(7, -30, 50), 1.F);
  grid->transform().postTranslate({0.25, 0.5, 0});
  const auto model = ReadVdb(BytesOf({grid}, metadata));
  ASSERT_TRUE(model.ok());
  const auto box = model->surface->evalActiveVoxelBoundingBox();
  const openvdb::Vec3d center = model->surface->indexToWorld(box.getCenter());
  EXPECT_LT((center - openvdb::Vec3d(7.25, 50, 29.5)).length(), 0.6);
  EXPECT_LT(model->surface->tree().getValue(
                model->surface->transform().worldToIndexCellCentered(openvdb::Vec3d(7, 50, 30))),
            0);
  EXPECT_EQ(model->surface->activeVoxelCount(), grid->activeVoxelCount());
}

TEST(ReadVdb, FilesWithoutALevelSetAreAnErrorThatListsWhatTheyHold) {
  const auto fog = openvdb::FloatGrid::create();
  fog->setName("density");
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  for (const openvdb::GridPtrVec& grids :
       {openvdb::GridPtrVec{}, {fog}, {openvdb::Vec3SGrid::create(), fog}}) {
    const auto model = ReadVdb(BytesOf(grids));
    ASSERT_FALSE(model.ok());
    EXPECT_EQ(model.diagnostics()[0].code, "not-level-set");
    EXPECT_EQ(model.diagnostics()[0].failure, FailureKind::kInput);
    EXPECT_EQ(model.diagnostics()[0].message.find("'density' (fog volume)") != std::string::npos,
              !grids.empty());
  }
}

TEST(ReadVdb, TransformsThatStretchOrTurnAreAnError) {
  const auto stretched = SampleLevelSet(1), turned = SampleLevelSet(1),
             mirrored = SampleLevelSet(1);
  stretched->transform().postScale(openvdb::Vec3d(1, 1, 1.5));
  turned->transform().postRotate(0.3, openvdb::math::Y_AXIS);
  mirrored->transform().postScale(openvdb::Vec3d(-1, 1, 1));
  for (const auto& grid : {stretched, turned, mirrored}) EXPECT_EQ(ErrorOf(grid), "bad-transform");
}

TEST(ReadVdb, LevelSetsWithoutVoxelsOrDistancesAreAnError) {
  EXPECT_EQ(ErrorOf(openvdb::createLevelSet<openvdb::FloatGrid>(1.0)), "empty-grid");
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), INFINITY, 40.F}) {
    const auto grid = SampleLevelSet(1);
    grid->tree().setValueOn({5, 40, -3}, value);
    EXPECT_EQ(ErrorOf(grid), "bad-level-set") << value;
  }
}

TEST(ReadVdb, LevelSetsLargerThanAnyModelAreAnError) {
  const auto grid = SampleLevelSet(1);
  grid->tree().setValueOn({1 << 20, 0, 0}, 1.F);
  EXPECT_EQ(ErrorOf(grid), "too-large");
}

TEST(ReadVdb, BytesOfOtherKindsAreAnError) {
  const std::string whole = BytesOf({SampleLevelSet(1)});
  for (const std::string& bytes : {std::string(), std::string("<svg/>"), whole.substr(0, 70),
                                   whole.substr(0, 3000), whole.substr(0, whole.size() - 1)}) {
    const auto model = ReadVdb(bytes);
    ASSERT_FALSE(model.ok()) << bytes.size();
    EXPECT_EQ(model.diagnostics()[0].code, "not-vdb");
  }
}

}  // namespace
}  // namespace lascaux

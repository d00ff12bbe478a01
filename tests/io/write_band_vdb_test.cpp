#include "lascaux/io/write_band_vdb.h"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>

#include "io/temporary_folder.h"
#include "lascaux/io/write_vdb.h"
#include "lascaux/volume/level_set.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;

struct VdbFile {
  openvdb::MetaMap::Ptr metadata;
  openvdb::FloatGrid::Ptr grid;
};

VdbFile Read(const std::filesystem::path& path) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open(/*delayLoad=*/false);
  return {file.getMetadata(), openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"))};
}

/// A creature's band, moved as the program moves it, with voxels that don't scale exactly.
NarrowBand RandomBand(Random& random) {
  const Field field = testing::RandomCreature(random);
  const double voxel_size = Bounds(field).sizes().maxCoeff() / random.Uniform(20, 150);
  NarrowBand band = *RasteriseBand(field, {.voxel_size = voxel_size});
  band.origin.y() += random.Uniform(-1, 1);
  return band;
}

void ExpectSameTree(const openvdb::FloatTree& a, const openvdb::FloatTree& b) {
  ASSERT_TRUE(a.hasSameTopology(b));
  EXPECT_EQ(a.background(), b.background());
  auto value = a.cbeginValueAll(), other = b.cbeginValueAll();
  for (; value && other; ++value, ++other) {
    ASSERT_EQ(value.getBoundingBox(), other.getBoundingBox());
    ASSERT_EQ(*value, *other) << value.getBoundingBox();
    ASSERT_EQ(value.isValueOn(), other.isValueOn());
  }
  EXPECT_EQ(static_cast<bool>(value), static_cast<bool>(other));
}

TEST(WriteBandVdb, OpenVdbReadsWhatItWouldHaveWritten) {
  ForSeeds(12, [](Random& random) {
    const TemporaryFolder folder;
    const NarrowBand band = RandomBand(random);
    for (const Unit unit : {Unit::kMillimetre, Unit::kCentimetre, Unit::kMetre}) {
      const WriteVdbOptions options{.unit = unit, .metadata = {{"creator", "lascaux"}, {"a", ""}}};
      ASSERT_TRUE(WriteBandVdb(folder / "ours.vdb", band, options).empty());
      ASSERT_TRUE(WriteVdb(folder / "theirs.vdb", *ToLevelSet(band), options).empty());
      const VdbFile ours = Read(folder / "ours.vdb"), theirs = Read(folder / "theirs.vdb");
      ExpectSameTree(ours.grid->tree(), theirs.grid->tree());
      EXPECT_EQ(ours.grid->transform(), theirs.grid->transform());
      EXPECT_EQ(*ours.metadata, *theirs.metadata);
      theirs.grid->removeMeta(openvdb::GridBase::META_FILE_DELAYED_LOAD);
      EXPECT_EQ(static_cast<const openvdb::MetaMap&>(*ours.grid),
                static_cast<const openvdb::MetaMap&>(*theirs.grid));
    }
  });
}

TEST(WriteBandVdb, OpensWithDelayedLoading) {
  const TemporaryFolder folder;
  Random random(7);
  const NarrowBand band = RandomBand(random);
  ASSERT_TRUE(WriteBandVdb(folder / "a.vdb", band).empty());
  openvdb::initialize();
  openvdb::io::File file((folder / "a.vdb").string());
  file.open(/*delayLoad=*/true);
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
  ExpectSameTree(grid->tree(), Read(folder / "a.vdb").grid->tree());
}

TEST(WriteBandVdb, VoxelsThatOpenVdbRefusesAndFullDisksAreErrors) {
  const TemporaryFolder folder;
  Random random(7);
  NarrowBand band = RandomBand(random);
  const Diagnostics full = WriteBandVdb("/dev/full", band);
  ASSERT_EQ(full.size(), 1U);
  EXPECT_EQ(full[0].code, "cannot-write");
  band.voxel_size = 0.0144;
  const Diagnostics small = WriteBandVdb(folder / "a.vdb", band);
  ASSERT_EQ(small.size(), 1U);
  EXPECT_EQ(small[0].code, "voxel-too-small");
  EXPECT_TRUE(folder.Names().empty());
}

}  // namespace
}  // namespace lascaux

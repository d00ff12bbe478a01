#include <gtest/gtest.h>
#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "grid.h"
#include "lascaux/volume/level_set.h"
#include "lascaux/volume/volume_grids.h"
#include "mesh_details_of.h"
#include "run_pipeline.h"

/// The grids of all examples by OpenVDB's own check: with every drawing's crotches and creases.

namespace lascaux {
namespace {

std::string BytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ExampleLevelSets, PassOpenVdbsCheckButForAThousandthOfTheirSlopes) {
  int examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LASCAUX_EXAMPLES)) {
    if (entry.path().extension() != ".svg") continue;
    const std::string name = entry.path().stem().string();
    const Model model = RunPipeline(BytesOf(entry.path()), {});
    ASSERT_TRUE(model.grid) << name;
    const auto level_set = ToLevelSet(model.grid->surface);
    const openvdb::FloatGrid& grid = *level_set;
    EXPECT_EQ(openvdb::tools::checkLevelSet(grid, 8), "") << name;
    openvdb::tools::CheckLevelSet<openvdb::FloatGrid> check(grid);
    check.checkEikonal(true);
    const double share =
        static_cast<double>(check.valueCount()) / static_cast<double>(grid.activeVoxelCount());
    std::printf("%-12s level 8 passes, level 9 fails for %.4f %% of the active voxels\n",
                name.c_str(), 100 * share);
    EXPECT_LE(share, 1e-3) << name;
    const ModelVolume volume{model.grid->surface,
                             *model.field,
                             FieldPartsOf(model),
                             model.lift,
                             {.parts = true, .fog = true}};
    const auto grids = VolumeGrids(volume);
    ASSERT_TRUE(grids.ok()) << name;
    for (std::size_t g = 1; g < grids->size(); ++g) {
      const auto part = openvdb::gridConstPtrCast<openvdb::FloatGrid>((*grids)[g]);
      const bool fog = part->getName() == "density";
      EXPECT_EQ(
          fog ? openvdb::tools::checkFogVolume(*part) : openvdb::tools::checkLevelSet(*part, 8), "")
          << name << ' ' << part->getName();
    }
    ++examples;
  }
  EXPECT_GE(examples, 16);
}

}  // namespace
}  // namespace lascaux

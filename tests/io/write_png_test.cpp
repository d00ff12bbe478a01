#include "lascaux/io/write_png.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "io/plugin_loader.h"
#include "io/samples.h"
#include "io/temporary_folder.h"
#include "lascaux/io/output_file.h"
#include "lascaux/io/write_exr.h"

namespace lascaux {
namespace {

/// True when a library of this name is mapped into the process.
bool IsLoaded(const std::string& name) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find(name) != std::string::npos) return true;
  }
  return false;
}

// The first of these tests that runs: those after it load the plugin.
TEST(WritePng, OnlyOtherPicturesLoadOpenImageIO) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePng(folder / "a.png", SamplePicture(3, 2)).empty());
  EXPECT_FALSE(IsLoaded("libOpenImageIO"));
  ASSERT_TRUE(WriteExr(folder / "a.exr", SampleLayers(3, 2)).empty());
  EXPECT_TRUE(IsLoaded("libOpenImageIO"));
}

TEST(WritePng, TheSamePictureGivesTheSameBytes) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePng(folder / "a.png", SamplePicture(40, 30)).empty());
  ASSERT_TRUE(WritePng(folder / "b.png", SamplePicture(40, 30)).empty());
  const std::string bytes = Contents(folder / "a.png");
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(bytes, Contents(folder / "b.png"));
}

TEST(WriteExr, TheSamePictureGivesTheSameBytes) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteExr(folder / "a.exr", SampleLayers(40, 30)).empty());
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a clock in it would have moved
  ASSERT_TRUE(WriteExr(folder / "b.exr", SampleLayers(40, 30)).empty());
  EXPECT_EQ(Contents(folder / "a.exr"), Contents(folder / "b.exr"));
}

TEST(WritePng, AFullDiskIsAnError) {
  for (const Diagnostics& diagnostics : {WritePng("/dev/full", SamplePicture(40, 30)),
                                         WriteExr("/dev/full", SampleLayers(40, 30))}) {
    ASSERT_EQ(diagnostics.size(), 1U);
    EXPECT_EQ(diagnostics[0].code, "cannot-write");
  }
}

TEST(LoadImagePlugin, AMissingOrBrokenPluginIsAnErrorThatNamesThePlaces) {
  const TemporaryFolder empty, broken;
  ASSERT_TRUE(WriteBytes(broken / "lascaux_image.so", "no library").empty());
  for (const TemporaryFolder* folder : {&empty, &broken}) {
    const auto plugin = LoadImagePlugin({folder->path()});
    ASSERT_FALSE(plugin.ok());
    EXPECT_EQ(plugin.diagnostics()[0].code, "image-plugin-missing");
    EXPECT_EQ(plugin.diagnostics()[0].failure, FailureKind::kOutput);
    EXPECT_NE(plugin.diagnostics()[0].message.find(folder->path().string()), std::string::npos);
  }
}

}  // namespace
}  // namespace lascaux

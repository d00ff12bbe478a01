#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "lascaux/volume/render_grids.h"
#include "render/animal.h"

namespace lascaux {
namespace {

openvdb::FloatGrid::Ptr Sphere() {
  openvdb::initialize();
  static const openvdb::FloatGrid::Ptr grid =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(20.F, openvdb::Vec3f(0, 20, 0),
                                                               0.5F);
  return grid;
}

openvdb::FloatGrid::Ptr SmallAnimal() {
  static const openvdb::FloatGrid::Ptr grid = Animal(80);
  return grid;
}

const std::uint8_t* Pixel(const Image& image, int x, int y) {
  return image.rgba.data() + 4 * (y * image.width + x);
}

/// Clay is warm, paper and shadows are nearly grey.
bool IsModel(const Image& image, int x, int y) {
  const std::uint8_t* const p = Pixel(image, x, y);
  return p[0] - p[2] > 20;
}

struct Box {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
  int pixels = 0;
};

Box ModelBox(const Image& image) {
  Box box;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!IsModel(image, x, y)) continue;
      box.left = std::min(box.left, x), box.right = std::max(box.right, x);
      box.top = std::min(box.top, y), box.bottom = std::max(box.bottom, y);
      ++box.pixels;
    }
  }
  return box;
}

Image Picture(const openvdb::FloatGrid::Ptr& grid, const RenderOptions& options = {}) {
  const auto picture = Render({grid}, options);
  EXPECT_TRUE(picture.ok());
  return ToImage(*picture);
}

TEST(Render, ASphereIsADiscInTheMiddle) {
  for (const View view : {View::kSide, View::kFront, View::kThreeQuarter, View::kTop}) {
    const Image image = Picture(Sphere(), {.view = view});
    const Box box = ModelBox(image);
    const double width = box.right - box.left + 1, height = box.bottom - box.top + 1;
    EXPECT_NEAR(width, 0.8 * 512, 12);
    EXPECT_NEAR(height, width, 3);
    EXPECT_NEAR(box.pixels, M_PI / 4 * width * width, 0.01 * width * width);
    EXPECT_NEAR(box.left, 511 - box.right, 2);
  }
}

TEST(Render, TheModelFillsTheFrameFromEverySide) {
  const auto grid = SmallAnimal();
  for (const auto& [width, height] : {std::pair{256, 256}, {384, 128}, {100, 300}}) {
    for (const View view : {View::kSide, View::kFront, View::kThreeQuarter, View::kTop}) {
      const Box box = ModelBox(Picture(grid, {.width = width, .height = height, .view = view}));
      const double across = static_cast<double>(box.right - box.left + 1) / width;
      const double down = static_cast<double>(box.bottom - box.top + 1) / height;
      EXPECT_NEAR(std::max(across, down), 0.8, 0.05);
      EXPECT_NEAR(box.left, width - 1 - box.right, 0.02 * width + 2);
    }
  }
}

TEST(Render, LightComesFromTheUpperLeftAndShadowFallsOnPaleGround) {
  const Image image = Picture(Sphere());
  EXPECT_GT(Pixel(image, 180, 180)[1], Pixel(image, 350, 370)[1] + 40);
  for (const int corner : {0, 511}) EXPECT_GT(Pixel(image, corner, 0)[1], 200);
  const Box box = ModelBox(image);
  EXPECT_LT(Pixel(image, 256, box.bottom + 3)[1] + 40, Pixel(image, 20, 500)[1]);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 255);
}

TEST(Render, OutlinesAreSmooth) {
  // On a row through the disc's flank, most outline pixels have a shade between paper and clay.
  const Image image = Picture(Sphere(), {.width = 256, .height = 256});
  int rows = 0, between = 0;
  for (int y = 60; y < 120; ++y) {
    int x = 0;
    while (!IsModel(image, x, y)) ++x;
    ++rows;
    const int before = Pixel(image, x - 2, y)[2], after = Pixel(image, x + 2, y)[2];
    const int low = std::min(before, after) + 12, high = std::max(before, after) - 12;
    for (const int at : {x - 1, x}) {
      if (Pixel(image, at, y)[2] > low && Pixel(image, at, y)[2] < high) {
        ++between;
        break;
      }
    }
  }
  EXPECT_GT(between, 0.6 * rows);
}

TEST(Render, ThreeQuarterViewsShowTheHeadWhereverItLooks) {
  const Image right = Picture(SmallAnimal()), left = Picture(AnimalTurned(80));
  int different = 0, model = 0;
  for (int y = 0; y < right.height; ++y) {
    for (int x = 0; x < right.width; ++x) {
      model += IsModel(right, x, y);
      different += IsModel(right, x, y) != IsModel(left, left.width - 1 - x, y);
    }
  }
  EXPECT_LT(different, 0.02 * model);
}

TEST(Render, TheHeadIsWhereTheOptionsSay) {
  const auto grid = SmallAnimal();
  const Image guess = Picture(grid);
  EXPECT_TRUE(guess == Picture(grid, {.head = Head::kRight}));
  EXPECT_FALSE(guess == Picture(grid, {.head = Head::kLeft}));
}

TEST(Render, TheUnitDoesNotMatter) {
  const auto grid = SmallAnimal();
  const Image expected = Picture(grid);
  const auto scaled = grid->deepCopy();
  constexpr float kFactor = 0.001F;
  scaled->transform().postScale(kFactor);
  for (auto value = scaled->beginValueAll(); value; ++value) value.setValue(kFactor * *value);
  scaled->tree().root().setBackground(kFactor * grid->background(), /*updateChildNodes=*/false);
  const Image image = Picture(scaled);
  int largest = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    largest = std::max(largest, std::abs(image.rgba[i] - expected.rgba[i]));
  }
  EXPECT_LE(largest, 16);  // single pixels of edges
}

TEST(Render, TheSameBytesForAnyNumberOfThreads) {
  const auto grid = SmallAnimal();
  Execution execution;
  execution.threads = 1;
  const auto expected = Render({grid}, {}, execution);
  for (const int threads : {2, 4}) {
    execution.threads = threads;
    EXPECT_TRUE(*Render({grid}, {}, execution) == *expected) << threads;
  }
}

TEST(Render, OnePixelIsAPicture) {
  const Image image = Picture(Sphere(), {.width = 1, .height = 1});
  EXPECT_EQ(image.rgba.size(), 4U);
}

TEST(Render, AnEmptyGridIsAnError) {
  openvdb::initialize();
  const auto image = Render({openvdb::createLevelSet<openvdb::FloatGrid>(1.0)});
  ASSERT_FALSE(image.ok());
  EXPECT_EQ(image.diagnostics()[0].code, "empty-grid");
}

#if !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)  // which end the program instead
TEST(Render, APictureThatDoesNotFitIntoMemoryIsAnError) {
  const auto image = Render({Sphere()}, {.width = 1'000'000, .height = 1'000'000});
  ASSERT_FALSE(image.ok());
  EXPECT_EQ(image.diagnostics()[0].code, "out-of-memory");
}
#endif

TEST(Render, ACancelledRunIsAnError) {
  const std::atomic<bool> cancel = true;
  Execution execution;
  execution.cancel = &cancel;
  const auto image = Render({Sphere()}, {}, execution);
  ASSERT_FALSE(image.ok());
  EXPECT_EQ(image.diagnostics()[0].code, "cancelled");
  EXPECT_EQ(image.diagnostics()[0].failure, FailureKind::kInterrupted);
}

}  // namespace
}  // namespace lascaux

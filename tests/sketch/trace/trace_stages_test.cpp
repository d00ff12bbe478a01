#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sketch/drawings.h"
#include "sketch/trace/centre_lines.h"
#include "sketch/trace/distance.h"
#include "sketch/trace/filters.h"
#include "sketch/trace/fuzz_picture.h"
#include "sketch/trace/pen.h"
#include "sketch/trace/regions.h"
#include "sketch/trace/thin.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;
using lascaux::testing::ForSeeds;
using lascaux::testing::Random;

Mask RandomMask(Random& random) {
  Mask mask(random.Integer(3, 40), random.Integer(3, 40));
  const double density = random.Uniform(0.05, 0.95);
  for (int y = 1; y + 1 < mask.height; ++y)
    for (int x = 1; x + 1 < mask.width; ++x) mask(x, y) = random.Chance(density) ? 1 : 0;
  return mask;
}

TEST(TraceStages, DistancesAreThoseOfTheNearestPixelOutside) {
  ForSeeds(100, [](Random& random) {
    const Mask mask = RandomMask(random);
    const auto squared = SquaredDistances(mask);
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x) {
        int nearest = 1 << 20;
        for (int v = 0; v < mask.height; ++v)
          for (int u = 0; u < mask.width; ++u)
            if (!mask(u, v)) nearest = std::min(nearest, (u - x) * (u - x) + (v - y) * (v - y));
        ASSERT_EQ(squared(x, y), nearest) << x << " " << y;
      }
  });
}

TEST(TraceStages, DilationIsTheGreatestValueOfTheSquare) {
  ForSeeds(60, [](Random& random) {
    Tone tone(random.Integer(1, 30), random.Integer(1, 30));
    for (float& v : tone.data) v = static_cast<float>(random.Uniform(0, 1));
    const int radius = random.Integer(0, 12);
    const Tone dilated = Dilated(tone, radius), eroded = Eroded(tone, radius);
    for (int y = 0; y < tone.height; ++y)
      for (int x = 0; x < tone.width; ++x) {
        float most = 0, least = 1;
        for (int v = std::max(0, y - radius); v <= std::min(tone.height - 1, y + radius); ++v)
          for (int u = std::max(0, x - radius); u <= std::min(tone.width - 1, x + radius); ++u)
            most = std::max(most, tone(u, v)), least = std::min(least, tone(u, v));
        ASSERT_EQ(dilated(x, y), most);
        ASSERT_EQ(eroded(x, y), least);
      }
  });
}

TEST(TraceStages, BlurringKeepsTheMean) {
  Tone tone(50, 40, 0.25f);
  tone(25, 20) = 1;
  const Tone blurred = Blurred(tone, 2);
  double sum = 0, variance = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x) {
      const double v = static_cast<double>(blurred(x, y)) - 0.25;
      sum += v;
      variance += v * (x - 25) * (x - 25);
    }
  EXPECT_NEAR(sum, 0.75, 1e-4);
  EXPECT_NEAR(std::sqrt(variance / sum), 2, 0.5);
}

TEST(TraceStages, ThinningJoinsAndPartsNothing) {
  ForSeeds(200, [](Random& random) {
    const Mask mask = RandomMask(random);
    const Mask thin = Thinned(mask, SquaredDistances(mask));
    for (std::size_t i = 0; i < mask.data.size(); ++i) ASSERT_LE(thin.data[i], mask.data[i]);
    EXPECT_EQ(RegionsOf(thin, 1, Neighbours::kCorners).size(),
              RegionsOf(mask, 1, Neighbours::kCorners).size());
    EXPECT_EQ(RegionsOf(thin, 0, Neighbours::kEdges).size(),
              RegionsOf(mask, 0, Neighbours::kEdges).size());
  });
}

TEST(TraceStages, CentreOfAnOutlinedPenStrokeIsThePensPath) {
  const Stroke ring = lascaux::testing::Circle({3, 4}, 1),
               hole = lascaux::testing::Circle({3, 4}, 0.9);
  const Contours contours{ring.pieces, hole.pieces};
  const RasterFrame frame = FrameAround({Vector2d(2, 3), Vector2d(4, 5)}, 0.0125, 1e6);
  const auto lines = CentreLinesOf(Rasterised(contours, FillRule::kEvenOdd, frame), frame);
  ASSERT_TRUE(lines && lines->strokes.size() == 1);
  EXPECT_TRUE(lines->strokes[0].closed);
  EXPECT_NEAR(lines->strokes[0].width, 0.1, 0.01);
  EXPECT_GT(lines->gate.coverage, 0.99);
  EXPECT_EQ(lines->gate.ink_regions, lines->gate.curve_regions);
  for (const CubicBezier& piece : lines->strokes[0].pieces)
    for (const double t : {0.0, 0.3, 0.6})
      EXPECT_NEAR((piece.At(t) - Vector2d(3, 4)).norm(), 0.95, 0.01);
}

TEST(TraceStages, ShapeWithoutAreaHasNoCentreLine) {
  const RasterFrame frame = FrameAround({Vector2d(1, 1), Vector2d(2, 5)}, 0.1, 1e6);
  EXPECT_FALSE(CentreLinesOf(Rasterised({}, FillRule::kNonZero, frame), frame));
  const Contours line{{Line({1, 1}, {2, 5})}};
  EXPECT_FALSE(CentreLinesOf(Rasterised(line, FillRule::kNonZero, frame), frame));
}

TEST(TraceStages, EveryBitmapGivesASoundSketchOrAnInputError) {
  for (const auto& entry : std::filesystem::directory_iterator(LASCAUX_PICTURE_CORPUS)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_EQ(lascaux::testing::WrongWithTraceOf(bytes), "") << entry.path();
  }
  ForSeeds(150, [](Random& random) {
    std::string bytes;
    const int size = random.Integer(0, 4000), levels = random.Integer(1, 255);
    for (int i = 0; i < size; ++i)
      bytes.push_back(static_cast<char>(random.Integer(0, levels) * (255 / levels)));
    ASSERT_EQ(lascaux::testing::WrongWithTraceOf(bytes), "");
  });
}

}  // namespace
}  // namespace lascaux::trace

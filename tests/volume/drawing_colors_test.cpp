#include "lascaux/volume/drawing_colors.h"

#include <gtest/gtest.h>

namespace lascaux {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

const Array3f kRed(0.6F, 0.05F, 0.03F), kBlue(0.03F, 0.1F, 0.6F), kWhite(1, 1, 1);

/// A square that faces the viewer, two triangles of one part.
void AddSquare(const Vector3f& low, float side, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& [x, y] : {std::pair{0.F, 0.F}, {side, 0.F}, {side, side}, {0.F, side}})
    mesh.vertices.push_back(low + Vector3f(x, y, 0));
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// Part 0, 10 x 10 at z = 0; part 1 before it over its middle, part 2 behind it.
class DrawingColorsTest : public ::testing::Test {
 protected:
  DrawingColorsTest() {
    AddSquare({0, 0, 0}, 10, mesh_);
    AddSquare({3, 3, 1}, 4, mesh_);
    AddSquare({3, 3, -1}, 4, mesh_);
    page_.pixel = 0.1;
    page_.width = page_.height = 100;
    page_.colors.assign(10000, kRed);
    page_.known.assign(10000, 1);
    for (int y = 30; y < 70; ++y)
      for (int x = 30; x < 70; ++x) page_.colors[page_.Index(x, y)] = kBlue;
    frame_.shift = {0, 10};  // rows of the page run down
  }

  std::optional<DrawingColors> Project(std::vector<std::uint16_t> layers) const {
    return ProjectColors(page_, {mesh_, parts_, std::move(layers), frame_});
  }

  Mesh mesh_;
  std::vector<std::uint16_t> parts_ = {0, 0, 1, 1, 2, 2};
  PageColors page_;
  ModelFrame frame_;
};

void ExpectNear(const Array3f& a, const Array3f& b) {
  EXPECT_LT((a - b).abs().maxCoeff(), 4e-3F) << a.transpose() << " is not " << b.transpose();
}

TEST_F(DrawingColorsTest, EachPartHasWhatIsSeenOfItAndTheNearestOfThatElsewhere) {
  const auto colors = Project({0, 1, 1});
  ASSERT_TRUE(colors);
  ExpectNear(colors->At(0, 1, 1), kRed);
  ExpectNear(colors->At(0, 5, 5), kRed);  // behind part 1
  ExpectNear(colors->At(1, 5, 5), kBlue);
  ExpectNear(colors->At(2, 5, 5), kBlue);  // has part 1's layer
  EXPECT_GT(colors->OfPart(0)[0], 190);
  EXPECT_GT(colors->OfPart(1)[2], 190);
  EXPECT_EQ(colors->OfPart(2), colors->OfPart(1));
}

TEST_F(DrawingColorsTest, WhatIsNotKnownHasTheNearestColourAndWhatIsAllInkTheInks) {
  for (int y = 0; y < 100; ++y)
    page_.known[page_.Index(0, y)] = 0, page_.colors[page_.Index(0, y)] = kBlue;
  for (int y = 30; y < 70; ++y)
    for (int x = 30; x < 70; ++x) page_.known[page_.Index(x, y)] = 0;
  const auto colors = Project({0, 1, 2});
  ASSERT_TRUE(colors);
  ExpectNear(colors->At(0, 0.05F, 5), kRed);
  ExpectNear(colors->At(1, 5, 5), kBlue);
  ExpectNear(colors->At(2, 5, 5), kRed);  // nobody sees it: the first part's
}

TEST_F(DrawingColorsTest, AWhiteDrawingWithSomeInkHasNone) {
  page_.colors.assign(10000, kWhite);
  EXPECT_FALSE(Project({0, 1, 1}));
  for (int i = 0; i < 4000; ++i)
    page_.colors[static_cast<std::size_t>(i)] = Array3f::Constant(0.01F);
  EXPECT_FALSE(Project({0, 1, 1}));
  for (int i = 0; i < 600; ++i) page_.colors[static_cast<std::size_t>(i)] = kBlue;
  EXPECT_TRUE(Project({0, 1, 1}));
}

}  // namespace
}  // namespace lascaux

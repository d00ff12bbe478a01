#include "settle.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "grid.h"
#include "sample_model.h"

namespace lascaux {
namespace {

using testing::SampleModel;

TEST(StandOnGround, MovesMeshGridAndFrameAlike) {
  Model model = SampleModel();
  model.mesh = Mesh{{{0, -1.25f, 0}, {1, 3, 0}, {0, 0, 1}}, {{0, 1, 2}}};
  model.grid = std::make_shared<Grid>();
  const Eigen::Vector2d before = model.frame->ToModel({1, 1});
  StandOnGround(model);
  EXPECT_EQ(model.mesh->vertices[0].y(), 0);
  EXPECT_FLOAT_EQ(model.mesh->vertices[1].y(), 4.25f);
  EXPECT_DOUBLE_EQ(model.frame->ToModel({1, 1}).y(), before.y() + 1.25);
  EXPECT_DOUBLE_EQ(model.frame->ToModel({1, 1}).x(), before.x());
  EXPECT_DOUBLE_EQ(model.grid->surface.origin.y(), 1.25);
}

TEST(BuiltOutlines, LeaveOutFarAndIgnoredParts) {
  const Model model = SampleModel();
  const auto rings = BuiltOutlines(model);
  ASSERT_EQ(rings.size(), model.parts->parts.size());
  const auto is_there = [](const std::vector<Eigen::Vector2d>& ring) { return !ring.empty(); };
  EXPECT_EQ(std::count_if(rings.begin(), rings.end(), is_there), 3);  // body, near limb, eye
  EXPECT_EQ(rings[0][0], Eigen::Vector2d(-20, 30));
}

TEST(FindHead, IsWhereTheEyesAre) {
  Model model = SampleModel();
  EXPECT_EQ(FindHead(model), HeadEnd::kRight);
  for (Part& part : model.parts->parts)
    for (Eigen::Vector2d& point : part.outline.points) point.x() *= -1;
  EXPECT_EQ(FindHead(model), HeadEnd::kLeft);
  for (Eigen::Vector2d& point : model.parts->parts[4].outline.points) point.x() = -2;
  EXPECT_EQ(FindHead(model), HeadEnd::kUnknown);
  model.graph->nodes[4].role = PartRole::kIgnored;
  EXPECT_EQ(FindHead(model), HeadEnd::kUnknown);
}

}  // namespace
}  // namespace lascaux

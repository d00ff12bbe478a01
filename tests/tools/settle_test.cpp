#include "settle.h"

#include <gtest/gtest.h>

#include "sample_model.h"

namespace lascaux {
namespace {

using testing::SampleModel;

TEST(StandOnGround, MovesMeshGridAndFrameAlike) {
  Model model = SampleModel();
  model.mesh = Mesh{{{0, -1.25f, 0}, {1, 3, 0}, {0, 0, 1}}, {{0, 1, 2}}};
  model.grid = openvdb::FloatGrid::create();
  const Eigen::Vector2d before = model.frame->ToModel({1, 1});
  StandOnGround(model);
  EXPECT_EQ(model.mesh->vertices[0].y(), 0);
  EXPECT_FLOAT_EQ(model.mesh->vertices[1].y(), 4.25f);
  EXPECT_DOUBLE_EQ(model.frame->ToModel({1, 1}).y(), before.y() + 1.25);
  EXPECT_DOUBLE_EQ(model.frame->ToModel({1, 1}).x(), before.x());
  EXPECT_DOUBLE_EQ(model.grid->indexToWorld(openvdb::Vec3d(0, 0, 0)).y(), 1.25);
}

TEST(BuiltOutlines, LeaveOutFarAndIgnoredParts) {
  const auto rings = BuiltOutlines(SampleModel());
  ASSERT_EQ(rings.size(), 3u);  // body, near limb, eye
  EXPECT_EQ(rings[0][0], Eigen::Vector2d(-20, 30));
}

TEST(NotPrintable, SaysWhatIsWrong) {
  MeshFacts facts;
  facts.closed = facts.manifold = true;
  facts.components = 3;
  facts.self_intersections = 2;
  const Diagnostic error = NotPrintable(facts);
  EXPECT_EQ(error.code, "mesh-not-printable");
  EXPECT_EQ(error.failure, FailureKind::kMesh);
  for (const char* part : {"outward", "3 pieces", "2 pairs"})
    EXPECT_NE(error.message.find(part), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find("open"), std::string::npos);
}

}  // namespace
}  // namespace lascaux

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "io/samples.h"
#include "io/temporary_folder.h"
#include "lascaux/io/write_ply.h"
#include "lascaux/io/write_stl.h"

namespace lascaux {
namespace {

constexpr std::size_t kStlHeader = 84;

Eigen::Vector3f VectorAt(const std::string& bytes, std::size_t offset) {
  Eigen::Vector3f v;
  std::memcpy(v.data(), bytes.data() + offset, 12);
  return v;
}

TEST(WriteStl, ASphereHasItsVolumeAndStandsOnTheBed) {
  const TemporaryFolder folder;
  const Mesh mesh = SampleSphere(5);
  ASSERT_TRUE(WriteStl(folder / "a.stl", mesh).empty());
  const std::string bytes = Contents(folder / "a.stl");
  ASSERT_EQ(bytes.size(), kStlHeader + 50 * mesh.triangles.size());
  EXPECT_NE(bytes.substr(0, 5), "solid");
  double six_volumes = 0, lowest = 1e9, worst_normal = 0;
  for (std::size_t at = kStlHeader; at < bytes.size(); at += 50) {
    const Eigen::Vector3d a = VectorAt(bytes, at + 12).cast<double>();
    const Eigen::Vector3d b = VectorAt(bytes, at + 24).cast<double>();
    const Eigen::Vector3d c = VectorAt(bytes, at + 36).cast<double>();
    six_volumes += a.dot(b.cross(c));
    lowest = std::min({lowest, a.z(), b.z(), c.z()});
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    worst_normal = std::max(worst_normal, (normal - VectorAt(bytes, at).cast<double>()).norm());
  }
  // The inscribed polyhedron of 8192 faces lacks 0.2 % of the ball.
  EXPECT_NEAR(six_volumes / 6, 4 * M_PI / 3 * std::pow(kSampleRadius, 3), 100);
  EXPECT_EQ(lowest, 0);
  EXPECT_LT(worst_normal, 1e-7);
}

TEST(WriteStl, TurnsTheModelsUpIntoZ) {
  const TemporaryFolder folder;
  const Mesh mesh{{{1, 2, 3}, {4, 5, 6}, {7, 8, 0}}, {{0, 1, 2}}};
  ASSERT_TRUE(WriteStl(folder / "a.stl", mesh).empty());
  const std::string bytes = Contents(folder / "a.stl");
  EXPECT_EQ(VectorAt(bytes, kStlHeader + 12), Eigen::Vector3f(1, -3, 2));
  EXPECT_EQ(VectorAt(bytes, kStlHeader + 24), Eigen::Vector3f(4, -6, 5));
  EXPECT_FALSE(std::signbit(VectorAt(bytes, kStlHeader + 36).y()));
}

TEST(WriteStl, AFaceWithoutAreaHasNoNormal) {
  const TemporaryFolder folder;
  const Mesh mesh{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}};
  ASSERT_TRUE(WriteStl(folder / "a.stl", mesh).empty());
  EXPECT_EQ(VectorAt(Contents(folder / "a.stl"), kStlHeader), Eigen::Vector3f(0, 0, 0));
}

TEST(WriteStl, AnEmptyMeshIsAnEmptyFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteStl(folder / "a.stl", {}).empty());
  EXPECT_EQ(Contents(folder / "a.stl").size(), kStlHeader);
}

TEST(WriteStl, AFullDiskIsAnError) {
  const Diagnostics diagnostics = WriteStl("/dev/full", SampleSphere(5));
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].code, "cannot-write");
}

TEST(WritePly, HoldsTheUnitTheScaledVerticesAndUnitNormals) {
  const TemporaryFolder folder;
  const Mesh mesh = SampleSphere(4);
  for (const Unit unit : {Unit::kMillimetre, Unit::kCentimetre, Unit::kMetre}) {
    ASSERT_TRUE(WritePly(folder / "a.ply", mesh, {}, {.unit = unit}).empty());
    const std::string bytes = Contents(folder / "a.ply");
    EXPECT_NE(bytes.find(std::string("unit ") + Name(unit) + ","), std::string::npos);
    const std::size_t body = bytes.find("end_header\n") + 11;
    ASSERT_EQ(bytes.size(), body + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
    const auto factor = static_cast<float>(PerMillimetre(unit));
    float worst_place = 0, worst_normal = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Eigen::Vector3f place = VectorAt(bytes, body + 24 * i);
      worst_place = std::max(worst_place, (place / factor - mesh.vertices[i]).norm());
      const Eigen::Vector3f radial =
          (mesh.vertices[i] - Eigen::Vector3f(5, kSampleRadius, -3)).normalized();
      const Eigen::Vector3f normal = VectorAt(bytes, body + 24 * i + 12);
      worst_normal = std::max(worst_normal, (normal - radial).norm());
      EXPECT_FLOAT_EQ(normal.norm(), 1);
    }
    EXPECT_LT(worst_place, 1e-5F);
    EXPECT_LT(worst_normal, 0.03F);  // faces are 0.1 radian wide
  }
}

TEST(WritePly, AVertexInNoFaceHasNoNormal) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePly(folder / "a.ply", {{{1, 2, 3}}, {}}).empty());
  const std::string bytes = Contents(folder / "a.ply");
  EXPECT_EQ(VectorAt(bytes, bytes.size() - 12), Eigen::Vector3f(0, 0, 0));
}

TEST(WritePly, AFullDiskIsAnError) {
  const Diagnostics diagnostics = WritePly("/dev/full", SampleSphere(1));
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].code, "cannot-write");
}

}  // namespace
}  // namespace lascaux

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <vector>

#include "lascaux/volume/extract_mesh.h"
#include "lascaux/volume/mesh_details.h"
#include "lascaux/volume/part_of_points.h"
#include "lascaux/volume/stability.h"
#include "lascaux/volume/vertex_normals.h"
#include "lascaux/volume/wall_thickness.h"
#include "support/cases.h"
#include "volume/fields.h"
#include "volume/shapes.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using testing::AnimalField;
using testing::ForSeeds;
using testing::InsideOut;
using testing::Moved;
using testing::OnThreads;
using testing::Random;
using testing::RandomCreature;
using testing::Sphere;
using testing::Together;
using testing::Torus;

Mesh Scaled(Mesh mesh, float x, float y, float z) {
  for (Eigen::Vector3f& v : mesh.vertices) v = v.cwiseProduct(Eigen::Vector3f(x, y, z));
  return mesh;
}

TEST(SmallestWall, OfAFlatSphereIsItsThicknessSomewhereAndNeverMore) {
  const auto wall = SmallestWall(Scaled(Sphere(5), 3, 3, 0.5F));
  ASSERT_TRUE(wall);
  EXPECT_LE(wall->thickness, 1.0);
  const auto torus = SmallestWall(Torus(80));
  ASSERT_TRUE(torus);
  EXPECT_NEAR(torus->thickness, 1.4, 0.01);
  EXPECT_NEAR(std::hypot(torus->middle.x(), torus->middle.z()), 2, 0.02);
}

TEST(SmallestWall, OfAHollowBallIsItsShell) {
  const Mesh shell = Together(Sphere(5), InsideOut(Sphere(5, 0.9F)));
  const auto wall = SmallestWall(shell);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->thickness, 0.1, 0.003);
  EXPECT_NEAR(wall->middle.norm(), 0.95, 0.005);
}

TEST(SmallestWall, IsTheSameForAnyNumberOfThreadsAndByTryingEverything) {
  const Mesh mesh = Scaled(Torus(40), 1, 0.3F, 0.8F);
  const auto one = SmallestWall(mesh, OnThreads(1));
  ASSERT_TRUE(one);
  EXPECT_EQ(one, SmallestWall(mesh, OnThreads(2)));
}

TEST(SmallestWall, IsUnknownWithoutSidesAndForBrokenMeshes) {
  EXPECT_FALSE(SmallestWall({}));
  EXPECT_FALSE(SmallestWall(InsideOut(Sphere(2))));
  Mesh mesh = Sphere(2);
  mesh.triangles[0][0] = 1000;
  EXPECT_FALSE(SmallestWall(mesh));
  EXPECT_FALSE(MeasureStability(mesh, 0.1));
}

/// Eight corners of a box of 4 x 2 x 6 around (1, 1, 0).
Mesh Box() {
  Mesh box;
  for (int i = 0; i < 8; ++i)
    box.vertices.emplace_back(i & 1 ? 3 : -1, i & 2 ? 2 : 0, i & 4 ? 3 : -3);
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

TEST(Stability, ABoxStandsByHalfItsWidthAndABallOnAPointHardly) {
  const auto stability = MeasureStability(Box(), 0.1);
  ASSERT_TRUE(stability);
  EXPECT_TRUE(stability->center_of_mass.isApprox(Vector3d(1, 1, 0)));
  EXPECT_NEAR(stability->margin, 2, 1e-6);
  const auto falls = MeasureStability(Together(Sphere(4), Moved(Sphere(4), 5, 1, 0)), 0.01);
  ASSERT_TRUE(falls);
  EXPECT_FALSE(falls->Stands());
  EXPECT_NEAR(falls->margin, -2.5, 0.2);
}

TEST(Stability, WhatRollsComesToRestWhereItsWeightIsLowest) {
  EXPECT_EQ(MeasureStability(Sphere(4), 0.01)->tilt, 0);
  // Two balls side by side, one higher by 1 of 5: both on the ground after asin(1 / sqrt(26)).
  const auto pair = MeasureStability(Together(Sphere(5), Moved(Sphere(5), 5, 1, 0)), 0.002);
  EXPECT_NEAR(pair->tilt, 11.3, 1);
  // On its end, with a weight beside it.
  const auto weight = Moved(Scaled(Sphere(3), 0.3F, 0.3F, 0.3F), 1, 0, 0);
  EXPECT_EQ(MeasureStability(Together(Scaled(Sphere(4), 0.2F, 3, 0.2F), weight), 1e-4)->tilt,
            kFarthestTilt);
}

TEST(Stability, ATiltedBoxComesToRestOnAFaceThatIsLargerThanStepsAreFine) {
  Mesh box = Box();
  const Eigen::AngleAxisf turn(10.3F * static_cast<float>(M_PI) / 180, Eigen::Vector3f::UnitZ());
  for (auto& vertex : box.vertices) vertex = turn * vertex;
  EXPECT_NEAR(MeasureStability(box, 1e-3)->tilt, 10.3, 0.5);
}

TEST(Stability, IsUnknownWhereFacesOfNoSolidNearlyCancel) {
  const Mesh inside_out = InsideOut(Scaled(Moved(Sphere(4), 5, 0, 0), 1, 1, 1.0001F));
  EXPECT_FALSE(MeasureStability(Together(Sphere(4), inside_out), 0.1));
}

TEST(PartOfPoints, IsThePartWhoseOwnFieldCountsMost) {
  ForSeeds(10, [](Random& random) {
    const Field field = RandomCreature(random);
    const Eigen::AlignedBox3d box = Bounds(field);
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 300; ++i) points.push_back(random.InBox(box).cast<float>());
    const Vector3d offset(0.5, -0.25, 0.125);
    const auto parts = PartOfPoints(field, points, offset, OnThreads(2));
    EXPECT_EQ(parts, PartOfPoints(field, points, offset, OnThreads(1)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d place = points[i].cast<double>() + offset;
      double best = 0, own = 0;
      for (int p = 0; p < static_cast<int>(field.parts.size()); ++p) {
        double value = EvaluatePart(field, p, place).value;
        for (auto q = field.parts[static_cast<std::size_t>(p)].parent; q;
             q = field.parts[static_cast<std::size_t>(*q)].parent)
          value *= double{kSayOfChild};
        best = std::max(best, value);
        if (p == parts[i]) own = value;
      }
      EXPECT_NEAR(own, best, 1e-3 * std::max(1.0, best));
      if (parts[i] == kNoPart) {
        EXPECT_LT(best, 1e-4);
      }
    }
  });
}

TEST(FieldNormals, OfABallAreRadial) {
  Field field;
  field.parts.emplace_back().chains.emplace_back().points.push_back({{1, 2, 3}, 10, 4});
  const Mesh mesh = Sphere(4, 5);
  const auto normals = FieldNormals(mesh, field, Vector3d(1, 2, 3));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals[i].norm(), 1, 1e-6);
    EXPECT_GT(normals[i].dot(mesh.vertices[i].normalized()), 0.9999);
  }
}

TEST(FieldNormals, AreThoseThatTheMeshKnows) {
  const Field field = AnimalField();
  const auto band = RasteriseBand(field, {0.03});
  ASSERT_TRUE(band.ok());
  Mesh mesh = *ExtractMesh(*band, field);
  ASSERT_EQ(mesh.outward.size(), mesh.vertices.size());
  const auto known = FieldNormals(mesh, field, Vector3d::Zero());
  mesh.outward.clear();
  const auto evaluated = FieldNormals(mesh, field, Vector3d::Zero());
  std::vector<float> cosines;
  for (std::size_t v = 0; v < known.size(); ++v) {
    EXPECT_NEAR(known[v].norm(), 1, 1e-5);
    cosines.push_back(known[v].dot(evaluated[v]));
  }
  std::sort(cosines.begin(), cosines.end());
  // One in a hundred is by more than 2 degrees different: in creases, and where pieces meet.
  EXPECT_GT(cosines[cosines.size() / 100], 0.9994);
}

TEST(PartColor, TellsManyPartsApart) {
  std::set<Srgb8> colors;
  for (int i = 0; i < 40; ++i) colors.insert(PartColor(i));
  EXPECT_EQ(colors.size(), 40U);
  EXPECT_EQ(PartColor(0), (Srgb8{219, 165, 111}));
}

TEST(PartsOfTriangles, AreThoseOfTwoCorners) {
  EXPECT_EQ(PartsOfTriangles(Triangles{{0, 1, 2}, {0, 1, 3}, {3, 1, 0}, {0, 2, 3}}, {7, 8, 8, 9}),
            (std::vector<std::uint16_t>{8, 7, 9, 7}));
}

}  // namespace
}  // namespace lascaux

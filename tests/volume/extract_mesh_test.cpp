#include "lascaux/volume/extract_mesh.h"

#include <gtest/gtest.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/level_set.h"
#include "volume/fields.h"
#include "volume/shapes.h"
#include "volume/shells.h"

namespace lascaux {
namespace {

constexpr double kFineVoxel = 0.01;  // of meshes that are made by hand: finer than their pieces

using testing::AnimalField;
using testing::RandomField;
using testing::Sphere;
using testing::SphereField;

openvdb::FloatGrid::Ptr EmptyGrid() {
  auto grid = openvdb::FloatGrid::create(3);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

std::string Defects(const Mesh& mesh) {
  std::string codes;
  for (const Diagnostic& d : MeshDefects(CheckMesh(mesh))) codes += d.code + " ";
  return codes;
}

TEST(ExtractMesh, ASphereIsASphere) {
  const auto grid = Rasterise(SphereField({0.3, 0.1, 0}, 1), {0.04});
  ASSERT_TRUE(grid.ok());
  const auto mesh = ExtractMesh(**grid);
  ASSERT_TRUE(mesh.ok());
  EXPECT_TRUE(mesh.diagnostics().empty());
  const MeshFacts facts = CheckMesh(*mesh);
  EXPECT_TRUE(facts.IsPrintable());
  EXPECT_EQ(facts.genus, 0);
  EXPECT_NEAR(facts.volume, 4.0 / 3 * std::numbers::pi, 0.01);
  EXPECT_NEAR(facts.area, 4 * std::numbers::pi, 0.03);
  for (const auto& v : mesh->vertices) {
    EXPECT_NEAR((v - Eigen::Vector3f(0.3F, 0.1F, 0)).norm(), 1, 1e-3);
  }
}

TEST(ExtractMesh, AnAnimalIsPrintable) {
  for (const double h : {0.1, 0.05, 0.023}) {
    const auto grid = Rasterise(AnimalField(), {h});
    ASSERT_TRUE(grid.ok());
    const auto mesh = ExtractMesh(**grid);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(Defects(*mesh), "") << h;
  }
}

TEST(ExtractMesh, RandomFieldsArePrintable) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const auto grid = Rasterise(RandomField(seed), {0.06});
    ASSERT_TRUE(grid.ok());
    const auto mesh = ExtractMesh(**grid);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(Defects(*mesh), "") << "seed " << seed;
  }
}

TEST(ExtractMesh, VerticesAreOnTheFieldsSurface) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Field field = seed == 0 ? AnimalField() : RandomField(seed);
    const double h = 0.05;
    const auto band = RasteriseBand(field, {h});
    ASSERT_TRUE(band.ok());
    const auto mean = ExtractMesh(*band), mesh = ExtractMesh(*band, field);
    ASSERT_TRUE(mean.ok() && mesh.ok());
    EXPECT_EQ(Defects(*mesh), "") << "seed " << seed;
    ASSERT_EQ(mesh->vertices.size(), mean->vertices.size());
    std::vector<double> distances;
    for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
      // Within the cell: by less than its diagonal.
      ASSERT_LT((mesh->vertices[i] - mean->vertices[i]).norm(), 1.8 * h);
      if (i % 16 != 0) continue;
      const FieldSample sample = Evaluate(field, mesh->vertices[i].cast<double>());
      distances.push_back(std::abs(SignedDistance(sample)) / h);
    }
    std::sort(distances.begin(), distances.end());
    // Where unblended parts meet is a crease, on which no vertex is.
    EXPECT_LT(distances[distances.size() * (seed == 0 ? 99 : 95) / 100], 0.02) << "seed " << seed;
  }
}

/// The surface by OpenVDB, its largest shell.
Mesh ByOpenVdb(const openvdb::FloatGrid& grid) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(grid, points, quads, 0.0);
  Mesh mesh;
  for (const openvdb::Vec3s& p : points) mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const openvdb::Vec4I& q : quads) {  // clockwise
    mesh.triangles.push_back({q[0], q[2], q[1]});
    mesh.triangles.push_back({q[0], q[3], q[2]});
  }
  return *KeepLargestShell(mesh, kFineVoxel);
}

/// The largest distance of a vertex from the nearest of the other mesh.
float FarthestVertex(const Mesh& mesh, const Mesh& from) {
  float farthest = 0;
  for (const Eigen::Vector3f& v : mesh.vertices) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const Eigen::Vector3f& w : from.vertices)
      nearest = std::min(nearest, (v - w).squaredNorm());
    farthest = std::max(farthest, nearest);
  }
  return std::sqrt(farthest);
}

TEST(ExtractMesh, HasTheVerticesAndFacesOfVolumeToMesh) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    constexpr float kVoxel = 0.09F;
    const Field field = seed == 0 ? AnimalField() : RandomField(seed);
    const auto grid = Rasterise(field, {static_cast<double>(kVoxel)});
    ASSERT_TRUE(grid.ok());
    const Mesh peer = ByOpenVdb(**grid);
    const auto mesh = ExtractMesh(**grid);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->triangles.size(), peer.triangles.size()) << "seed " << seed;
    EXPECT_EQ(mesh->vertices.size(), peer.vertices.size()) << "seed " << seed;
    EXPECT_EQ(CheckMesh(*mesh).genus, CheckMesh(peer).genus) << "seed " << seed;
    EXPECT_LT(FarthestVertex(*mesh, peer), 1e-4F * kVoxel) << "seed " << seed;
    EXPECT_LT(FarthestVertex(peer, *mesh), 1e-4F * kVoxel) << "seed " << seed;
  }
}

TEST(ExtractMesh, NoiseIsStillOneManifold) {
  // Every ambiguous cell there is, with zeros and values next to zero.
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto grid = EmptyGrid();
    auto value = grid->getAccessor();
    for (int x = -1; x < 12; ++x) {
      for (int y = -1; y < 12; ++y) {
        for (int z = -1; z < 12; ++z) {
          const bool is_rim = std::min({x, y, z}) < 0 || std::max({x, y, z}) > 10;
          float v = uniform(random);
          if (seed % 4 == 1) v = std::copysign(1.0F, v);
          if (seed % 4 == 2) v = v > 0.5F ? 0.0F : v;
          if (seed % 4 == 3) v *= 1e-6F;
          value.setValue({x, y, z}, is_rim ? 1.0F : v);
        }
      }
    }
    const auto mesh = ExtractMesh(*grid);
    ASSERT_TRUE(mesh.ok()) << "seed " << seed;
    EXPECT_EQ(Defects(*mesh), "") << "seed " << seed;
  }
}

TEST(ExtractMesh, OneVoxelInsideIsASolid) {
  const auto grid = EmptyGrid();
  auto value = grid->getAccessor();
  for (int x = 999; x < 1002; ++x) {
    for (int y = -1; y < 2; ++y) {
      for (int z = -1; z < 2; ++z) value.setValue({x, y, z}, 1);
    }
  }
  for (const float inside : {-1.0F, -1e-9F, -0.004F}) {
    value.setValue({1000, 0, 0}, inside);
    const auto mesh = ExtractMesh(*grid);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(Defects(*mesh), "") << inside;
    EXPECT_EQ(mesh->vertices.size(), 8U);
  }
}

/// The mesh of a ball of radius 1 beside one of that radius at (3, 0, 0), with voxels of 0.1.
Outcome<Mesh> MeshBesideCrumb(double radius) {
  Field field = SphereField({0, 0, 0}, 1);
  field.parts.push_back(SphereField({3, 0, 0}, radius).parts.front());
  return ExtractMesh(**Rasterise(field, {0.1}));
}

void ExpectCrumb(const Outcome<Mesh>& mesh, Severity severity, const std::string& message) {
  ASSERT_TRUE(mesh.ok());
  ASSERT_EQ(mesh.diagnostics().size(), 1U);
  EXPECT_EQ(mesh.diagnostics().front().code, "crumb-removed");
  EXPECT_EQ(mesh.diagnostics().front().severity, severity);
  EXPECT_NE(mesh.diagnostics().front().message.find(message), std::string::npos);
}

TEST(ExtractMesh, CrumbsAreRemovedWithAWarning) {
  const auto mesh = MeshBesideCrumb(0.3);
  ExpectCrumb(mesh, Severity::kWarning, "separate piece at (3,");
  EXPECT_EQ(Defects(*mesh), "");
  EXPECT_NEAR(CheckMesh(*mesh).volume, 4.0 / 3 * std::numbers::pi, 0.05);
}

TEST(ExtractMesh, WhatIsSmallerThanTwoVoxelsIsATipsTraceAndNoted) {
  ExpectCrumb(MeshBesideCrumb(0.08), Severity::kNote, "thinner than a voxel (0.1)");
}

TEST(ExtractMesh, IsTheSameForAnyNumberOfThreads) {
  const auto grid = Rasterise(AnimalField(), {0.03});
  ASSERT_TRUE(grid.ok());
  EXPECT_EQ(*ExtractMesh(**grid, testing::OnThreads(1)),
            *ExtractMesh(**grid, testing::OnThreads(2)));
}

TEST(ExtractMesh, NoSurfaceIsAnError) {
  const auto nothing = ExtractMesh(*EmptyGrid());
  ASSERT_FALSE(nothing.ok());
  EXPECT_EQ(nothing.diagnostics().front().code, "empty-mesh");
  EXPECT_EQ(nothing.diagnostics().front().failure, FailureKind::kUnderstanding);
}

TEST(ExtractMesh, StopsWhenCancelled) {
  const std::atomic<bool> cancel = true;
  const auto mesh = ExtractMesh(*EmptyGrid(), testing::CancelledBy(cancel));
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.diagnostics().front().code, "cancelled");
}

TEST(KeepLargestShell, RemovesCavities) {
  const Mesh cavity = testing::InsideOut(Sphere(3, 0.9F));
  const auto mesh = KeepLargestShell(testing::Together(cavity, Sphere(3)), kFineVoxel);
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(*mesh, Sphere(3));
  ASSERT_EQ(mesh.diagnostics().size(), 1U);
  EXPECT_NE(mesh.diagnostics().front().message.find("cavity"), std::string::npos);
}

TEST(KeepLargestShell, ManyCrumbsAreSummedUp) {
  Mesh mesh = Sphere(3);
  for (int i = 0; i < 25; ++i) {
    mesh = testing::Together(
        mesh, testing::Moved(testing::Tetrahedron(), 2.0F * static_cast<float>(i + 1), 0, 0));
  }
  const auto kept = KeepLargestShell(mesh, kFineVoxel);
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept.diagnostics().size(), 11U);
  EXPECT_EQ(*kept, Sphere(3));
}

TEST(KeepLargestShell, AnInsideOutShellAloneIsNoBody) {
  const auto mesh = KeepLargestShell(testing::InsideOut(Sphere(2)), kFineVoxel);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.diagnostics().front().code, "empty-mesh");
}

}  // namespace
}  // namespace lascaux

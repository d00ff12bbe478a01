#include "lascaux/volume/extract_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/level_set.h"
#include "volume/fields.h"
#include "volume/shapes.h"
#include "volume/shells.h"

namespace lascaux {
namespace {

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
    const MeshFacts facts = CheckMesh(*mesh);
    EXPECT_TRUE(facts.closed && facts.manifold && facts.oriented) << "seed " << seed;
    EXPECT_EQ(facts.components, 1) << "seed " << seed;
    EXPECT_EQ(facts.coincident, 0) << "seed " << seed;
    EXPECT_EQ(facts.degenerate, 0) << "seed " << seed;
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

TEST(ExtractMesh, CrumbsAreRemovedWithAWarning) {
  Field field = SphereField({0, 0, 0}, 1);
  field.parts.push_back(SphereField({3, 0, 0}, 0.3).parts.front());
  const auto grid = Rasterise(field, {0.1});
  ASSERT_TRUE(grid.ok());
  const auto mesh = ExtractMesh(**grid);
  ASSERT_TRUE(mesh.ok());
  ASSERT_EQ(mesh.diagnostics().size(), 1U);
  EXPECT_EQ(mesh.diagnostics().front().code, "crumb-removed");
  EXPECT_EQ(mesh.diagnostics().front().severity, Severity::kWarning);
  EXPECT_NE(mesh.diagnostics().front().message.find("separate piece at (3,"), std::string::npos);
  EXPECT_EQ(Defects(*mesh), "");
  EXPECT_NEAR(CheckMesh(*mesh).volume, 4.0 / 3 * std::numbers::pi, 0.05);
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
  const auto mesh = KeepLargestShell(testing::Together(cavity, Sphere(3)));
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
  const auto kept = KeepLargestShell(mesh);
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept.diagnostics().size(), 11U);
  EXPECT_EQ(*kept, Sphere(3));
}

TEST(KeepLargestShell, AnInsideOutShellAloneIsNoBody) {
  const auto mesh = KeepLargestShell(testing::InsideOut(Sphere(2)));
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.diagnostics().front().code, "empty-mesh");
}

}  // namespace
}  // namespace lascaux

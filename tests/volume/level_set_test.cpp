#include "lascaux/volume/level_set.h"

#include <gtest/gtest.h>
#include <openvdb/tools/Diagnostics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "lascaux/volume/render.h"
#include "lascaux/volume/render_grids.h"
#include "volume/band.h"
#include "volume/fields.h"
#include "volume/find_blocks.h"
#include "volume/shapes.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using openvdb::Coord;
using testing::AnimalField;
using testing::CylinderField;
using testing::RandomField;
using testing::SphereField;

openvdb::FloatGrid::Ptr Grid(const Field& field, double voxel_size) {
  auto grid = Rasterise(field, {voxel_size});
  EXPECT_TRUE(grid.ok());
  return grid.ok() ? *grid : nullptr;
}

std::string ErrorCode(const Field& field, double voxel_size, const Execution& execution = {}) {
  const auto grid = Rasterise(field, {voxel_size}, execution);
  EXPECT_FALSE(grid.ok());
  return grid.diagnostics().empty() ? "" : grid.diagnostics().back().code;
}

struct Errors {
  double mean = 0, largest = 0;
};

/// Errors of a grid's active values, in voxels; `distance` is negative inside, NaN where not known.
Errors Compare(const openvdb::FloatGrid& grid,
               const std::function<double(const Vector3d&)>& distance) {
  const double h = grid.voxelSize().x();
  Errors errors;
  int count = 0;
  for (auto value = grid.cbeginValueOn(); value; ++value) {
    const Coord c = value.getCoord();
    const double truth = distance(h * Vector3d(c.x(), c.y(), c.z()));
    if (!std::isfinite(truth)) continue;
    const double error = std::abs(static_cast<double>(*value) - truth) / h;
    errors.mean += error;
    errors.largest = std::max(errors.largest, error);
    ++count;
  }
  errors.mean /= count;
  return errors;
}

TEST(Rasterise, DistancesToASphereConverge) {
  const Vector3d center(0.013, 0.07, 0.02);
  const auto truth = [&](const Vector3d& p) { return (p - center).norm() - 1; };
  double last = std::numeric_limits<double>::infinity();
  for (const double radius : {4.0, 8.0, 16.0}) {  // in voxels
    const Errors errors = Compare(*Grid(SphereField(center, 1), 1 / radius), truth);
    EXPECT_LT(errors.mean, 0.3 * last) << radius;
    EXPECT_LT(errors.mean, 0.05 / radius) << radius;
    EXPECT_LT(errors.largest, radius > 4 ? 0.02 : 0.5) << radius;
    last = errors.mean;
  }
}

TEST(Rasterise, DistancesToACylinderConverge) {
  const Vector3d a(-6, 0.1, 0.05), b(6, 1.3, -0.2), along = (b - a).normalized();
  const auto truth = [&](const Vector3d& p) {
    const double t = (p - a).dot(along);
    const bool is_at_end = t < 4 || t > (b - a).norm() - 4;
    return is_at_end ? NAN : (p - a - t * along).norm() - 1;
  };
  double last = std::numeric_limits<double>::infinity();
  for (const double radius : {4.0, 8.0, 16.0}) {
    const Errors errors = Compare(*Grid(CylinderField(a, b, 1), 1 / radius), truth);
    EXPECT_LT(errors.mean, 0.35 * last) << radius;
    EXPECT_LT(errors.mean, 0.02 / radius) << radius;
    EXPECT_LT(errors.largest, 0.6 / radius) << radius;
    last = errors.mean;
  }
}

TEST(Rasterise, GridsAreLevelSetsByOpenVdbsRules) {
  for (const double h : {0.05, 0.02}) {
    const auto grid = Grid(AnimalField(), h);
    EXPECT_EQ(openvdb::tools::checkLevelSet(*grid, 8), "");
    openvdb::tools::CheckLevelSet<openvdb::FloatGrid> check(*grid);
    check.checkEikonal(true);
    EXPECT_LE(static_cast<double>(check.valueCount()),
              1e-3 * static_cast<double>(grid->activeVoxelCount()));
    EXPECT_GE(static_cast<double>(grid->background()), 3 * h);
    EXPECT_LT(static_cast<double>(std::nextafter(grid->background(), 0.0F)), 3 * h);
    EXPECT_EQ(grid->getName(), "surface");
  }
}

TEST(Rasterise, RandomFieldsAreLevelSetsThatMatchDenseEvaluation) {
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const Field field = RandomField(seed);
    const double h = seed % 2 == 0 ? 0.11 : 0.07;
    const auto grid = Grid(field, h);
    EXPECT_EQ(openvdb::tools::checkLevelSet(*grid, 8), "") << "seed " << seed;
    const auto value = grid->getConstAccessor();
    const int reach = static_cast<int>(3.5 / h);
    int wrong_side = 0, no_band = 0;
    for (int x = -reach; x < reach; ++x) {
      for (int y = -reach; y < reach; ++y) {
        bool was_inside = false;
        for (int z = -reach; z < reach; ++z) {
          const double f = Evaluate(field, h * Vector3d(x, y, z)).value;
          if (std::abs(f - 1) < 1e-3) continue;
          const bool is_inside = f > 1;
          wrong_side += (value.getValue({x, y, z}) < 0) != is_inside ? 1 : 0;
          no_band += is_inside != was_inside && !value.isValueOn({x, y, z}) ? 1 : 0;
          was_inside = is_inside;
        }
      }
    }
    EXPECT_EQ(wrong_side, 0) << "seed " << seed;
    EXPECT_EQ(no_band, 0) << "seed " << seed;
  }
}

TEST(Rasterise, ASymmetricFieldGivesASymmetricGrid) {
  const auto grid = Grid(AnimalField(), 0.04);
  const auto mirror = grid->getConstAccessor();
  int active = 0;
  for (auto value = grid->cbeginValueOn(); value; ++value, ++active) {
    const Coord c = value.getCoord(), image(c.x(), c.y(), -c.z());
    ASSERT_EQ(mirror.getValue(image), *value) << c;
    ASSERT_TRUE(mirror.isValueOn(image)) << c;
  }
  EXPECT_GT(active, 10000);
}

TEST(Rasterise, MirroringMakesNoDifference) {
  for (const double h : {0.11, 0.035}) {
    const auto half = Grid(AnimalField(), h);
    const auto whole = Grid(testing::WithoutMirror(AnimalField()), h);
    // Values at the rim of the band may fall in or out of it by rounding.
    const auto tolerance = static_cast<float>(2e-3 * h);
    const auto compare = [&](const openvdb::FloatGrid& one, const openvdb::FloatGrid& other) {
      const auto value = other.getConstAccessor();
      for (auto it = one.cbeginValueAll(); it; ++it) {
        if (it.isVoxelValue()) {
          ASSERT_NEAR(*it, value.getValue(it.getCoord()), tolerance) << it.getCoord();
        } else {
          ASSERT_EQ(*it < 0, value.getValue(it.getCoord()) < 0) << it.getCoord();
        }
      }
    };
    compare(*half, *whole);
    compare(*whole, *half);
  }
}

TEST(Rasterise, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto one = Rasterise(RandomField(3), {0.03}, testing::OnThreads(1));
  const auto two = Rasterise(RandomField(3), {0.03}, testing::OnThreads(2));
  ASSERT_TRUE(one.ok() && two.ok());
  ASSERT_TRUE((*one)->tree().hasSameTopology((*two)->tree()));
  const auto value = (*two)->getConstAccessor();
  for (auto it = (*one)->cbeginValueOn(); it; ++it) {
    ASSERT_EQ(*it, value.getValue(it.getCoord())) << it.getCoord();
  }
}

TEST(SweepDistances, GivesTheSameBitsForEveryInstructionSet) {
  constexpr double kVoxel = 0.05;
  const CompiledField field(AnimalField());
  BlockSearch search;
  search.voxel_size = kVoxel;
  search.margin = kBandVoxels + 0.5;
  const FoundBlocks found = FindBlocks(field, search, {});
  const BandSource source = {field, found.blocks, kVoxel};
  Band band = FindInside(source, {});
  ConnectBlocks(band);
  const std::vector<VoxelMask> crossings = FindCrossings(band);
  MeasureCrossings(source, crossings, band, {});
  Band baseline = band;
  SweepDistances(baseline, crossings, Isa::kBaseline, {});
  for (const Isa isa : {Isa::kAvx2, Isa::kAvx512}) {
    if (!IsSupported(isa)) continue;
    Band other = band;
    SweepDistances(other, crossings, isa, {});
    EXPECT_EQ(other.distance, baseline.distance) << Name(isa);
  }
}

TEST(Render, ABandLooksLikeItsGrid) {
  RenderOptions options{.width = 120, .height = 90};
  for (const Field& field : {AnimalField(), RandomField(5)}) {
    const auto band = RasteriseBand(field, {0.04});
    ASSERT_TRUE(band.ok());
    const auto direct = Render(*band, options);
    const auto grid = Render(ShownModel{ToLevelSet(*band)}, options);
    ASSERT_TRUE(direct.ok() && grid.ok());
    EXPECT_TRUE(*direct == *grid);
  }
}

TEST(Rasterise, WhatIsFarInsideIsATile) {
  const auto grid = Grid(SphereField({0, 0, 0}, 1), 0.02);
  EXPECT_EQ(grid->tree().getValueDepth({0, 0, 0}), 2);
  EXPECT_EQ(grid->tree().getValue({0, 0, 0}), -grid->background());
  EXPECT_EQ(grid->tree().getValue({0, 0, -20}), -grid->background());
  // The shell alone has leaves: about 4 pi 50^2 faces over 30 a leaf.
  EXPECT_LT(grid->tree().leafCount(), 1200U);
}

TEST(Rasterise, RefusesVoxelSizesOutOfRange) {
  const Field sphere = SphereField({0, 0, 0}, 1);
  for (const double size : {0.0, -1.0, 1e-6, 1e10, std::nan("")}) {
    EXPECT_EQ(ErrorCode(sphere, size), "bad-voxel-size") << size;
  }
  EXPECT_EQ(ErrorCode(SphereField({1e6, 0, 0}, 1), 0.1), "bad-voxel-size");
}

TEST(Rasterise, RefusesBadPrimitives) {
  EXPECT_EQ(ErrorCode(SphereField({0, std::nan(""), 0}, 1), 0.1), "bad-primitive");
}

TEST(Rasterise, RefusesFieldsWithoutABody) {
  EXPECT_EQ(ErrorCode({}, 0.1), "empty-field");
  EXPECT_EQ(ErrorCode(SphereField({0.5, 0.5, 0.5}, 0.1), 1), "empty-field");
  const auto failed = Rasterise({}, {0.1});
  EXPECT_EQ(failed.diagnostics().front().failure, FailureKind::kUnderstanding);
}

TEST(Rasterise, RefusesWhatDoesNotFitInMemory) {
  const Field sphere = SphereField({0, 0, 0}, 3);
  EXPECT_EQ(ErrorCode(sphere, 2.1e-4), "out-of-memory");
  const auto failed = Rasterise(sphere, {2.1e-4});
  EXPECT_EQ(failed.diagnostics().front().failure, FailureKind::kUsage);
}

TEST(Rasterise, StopsWhenCancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(ErrorCode(AnimalField(), 0.05, testing::CancelledBy(cancel)), "cancelled");
}

TEST(EstimateBytes, IsAtLeastWhatTheGridTakesAndNotAbsurdlyMore) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    for (const double h : {0.1, 0.03}) {
      const std::size_t estimate = EstimateBytes(RandomField(seed), {h});
      // A leaf, its three arrays of distances, its share of the mesh.
      const std::size_t used = 14'000 * Grid(RandomField(seed), h)->tree().leafCount();
      EXPECT_GE(estimate, used) << "seed " << seed;
      EXPECT_LE(estimate, 12 * used + 20'000'000) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace lascaux

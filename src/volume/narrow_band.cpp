#include "lascaux/volume/narrow_band.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <optional>
#include <vector>

#include "lascaux/base/arena.h"
#include "lascaux/field/compiled_field.h"
#include "volume/available_memory.h"
#include "volume/band.h"
#include "volume/find_blocks.h"
#include "volume/finish_band.h"
#include "volume/mirror.h"

namespace lascaux {
namespace {

// Half a voxel more than the band, for the neighbours that finding crossings looks at.
constexpr double kSearchMargin = kBandVoxels + 0.5;

Diagnostic Cancelled() {
  return Error(FailureKind::kInterrupted, "cancelled", "the run was stopped");
}

Diagnostic OutOfMemory(std::size_t estimate, std::size_t available) {
  return Error(
      FailureKind::kUsage, "out-of-memory",
      fmt::format("a grid this fine takes about {:.3g} MB, and {:.3g} MB are available: "
                  "ask for larger voxels",
                  1e-6 * static_cast<double>(estimate), 1e-6 * static_cast<double>(available)));
}

Diagnostic EmptyField() {
  return Error(FailureKind::kUnderstanding, "empty-field",
               "no voxel is inside the body: it is empty, or thinner than a voxel everywhere");
}

/// What is wrong with the size of the voxels for this field.
std::optional<Diagnostic> CheckVoxelSize(const Field& field, double voxel_size) {
  const auto bad = [](std::string message) {
    return Error(FailureKind::kUsage, "bad-voxel-size", std::move(message));
  };
  if (!(voxel_size >= kLeastVoxelSize && voxel_size <= kLargestVoxelSize)) {
    return bad(fmt::format("voxels of {:.6g} are asked for; {:.6g} to {:.6g} is possible",
                           voxel_size, kLeastVoxelSize, kLargestVoxelSize));
  }
  const Eigen::AlignedBox3d box = Bounds(field);
  if (box.isEmpty()) return std::nullopt;
  const double farthest =
      box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() / voxel_size;
  if (farthest <= kFarthestVoxel) return std::nullopt;
  return bad(
      fmt::format("the body reaches {:.6g} voxels of {:.6g} from the origin; {} are possible: "
                  "ask for larger voxels",
                  farthest, voxel_size, kFarthestVoxel));
}

BlockSearch SearchFor(const Field& field, double voxel_size) {
  return {voxel_size, kSearchMargin, IsMirrorSymmetric(field)};
}

/// A closer estimate than that from the primitives' sizes, which counts what lies inside of others:
/// the blocks of a grid that takes some tens of milliseconds, as many times as the
/// voxels' areas go into each other. Its band is thicker, so it is still no less than the need.
std::size_t EstimateByBlocks(const Field& field, double voxel_size, const Execution& execution) {
  constexpr double kCoarse = 512;        // voxels along the longest side
  constexpr double kBytesABlock = 18e3;  // measured: 10 KB, with its mirror image's
  const double coarse = std::max(voxel_size, Bounds(field).sizes().maxCoeff() / kCoarse);
  const BlockSearch search = SearchFor(field, coarse);
  const FoundBlocks found = FindBlocks(CompiledField(field), search, execution);
  const double blocks = static_cast<double>(found.blocks.size()) * (search.upper_half ? 2 : 1) *
                        std::pow(coarse / voxel_size, 2);
  return static_cast<std::size_t>(std::min(kBytesABlock * blocks, 1e18));
}

Outcome<NarrowBand> Fill(const Field& field, double voxel_size, const Execution& execution) {
  using Result = Outcome<NarrowBand>;
  const CompiledField compiled(field);
  const BlockSearch search = SearchFor(field, voxel_size);
  FoundBlocks found = FindBlocks(compiled, search, execution);

  const BandSource source = {compiled, found.blocks, voxel_size};
  Band band = FindInside(source, execution);
  if (execution.IsCancelled()) return Result::Failure(Cancelled());
  band.upper_half = search.upper_half;
  ConnectBlocks(band);
  std::vector<VoxelMask> crossings = FindCrossings(band);
  DropFarBlocks(found, band, crossings);
  if (band.size() == 0) return Result::Failure(EmptyField());

  MeasureCrossings(source, crossings, band, execution);
  SweepDistances(band, crossings, compiled.isa(), execution);
  RefineDistances(source, crossings, band, execution);
  if (execution.IsCancelled()) return Result::Failure(Cancelled());
  return FinishBand(band, found.inside, voxel_size);
}

}  // namespace

std::int64_t CountActive(const NarrowBand& band) {
  std::int64_t count = 0;
  for (const VoxelMask& mask : band.active) {
    for (const std::uint64_t word : mask) count += std::popcount(word);
  }
  return count;
}

Outcome<NarrowBand> RasteriseBand(const Field& field, const RasteriseOptions& options,
                                  const Execution& execution) {
  using Result = Outcome<NarrowBand>;
  if (Diagnostics wrong = Validate(field); HasError(wrong)) {
    return Result::Failure(std::move(wrong));
  }
  if (auto wrong = CheckVoxelSize(field, options.voxel_size)) {
    return Result::Failure(std::move(*wrong));
  }
  if (execution.IsCancelled()) return Result::Failure(Cancelled());
  const std::size_t available = AvailableMemory();
  std::size_t estimate = EstimateBytes(field, options);
  if (estimate > available) {
    RunInArena(execution, [&] {
      estimate = std::min(estimate, EstimateByBlocks(field, options.voxel_size, execution));
    });
  }
  if (estimate > available) return Result::Failure(OutOfMemory(estimate, available));
  try {
    std::optional<Result> result;
    RunInArena(execution, [&] { result = Fill(field, options.voxel_size, execution); });
    return std::move(*result);
  } catch (const std::bad_alloc&) {
    return Result::Failure(OutOfMemory(estimate, available));
  }
}

}  // namespace lascaux

#include "lascaux/volume/prepare_print.h"

#include <fmt/format.h>
#include <openvdb/tools/ParticlesToLevelSet.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lascaux/volume/level_set.h"
#include "volume/arena.h"
#include "volume/print/hollow.h"
#include "volume/print/plate.h"
#include "volume/print/stamp.h"
#include "volume/print/unchanged_cells.h"

namespace lascaux {
namespace {

using openvdb::FloatGrid;

constexpr double kThinnestVoxels = 2;  // of a wall: its two sides must not share voxels

/// Centres of balls, as OpenVDB wants to have them.
struct Balls {
  using PosType = openvdb::Vec3R;
  const std::vector<Wall>& walls;

  std::size_t size() const { return walls.size(); }
  void getPos(std::size_t i, PosType& p) const {
    p = {walls[i].middle.x(), walls[i].middle.y(), walls[i].middle.z()};
  }
};

void Thicken(FloatGrid& grid, const std::vector<Wall>& walls, double thickness) {
  if (walls.empty()) return;
  openvdb::tools::ParticlesToLevelSet<FloatGrid> raster(grid);
  raster.setRmin(0);
  raster.rasterizeSpheres(Balls{walls}, thickness / 2);
  raster.finalize(/*prune=*/true);
}

void AddPlate(FloatGrid& grid, const Plate& plate) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector2d& p : plate.hull) {
    box.extend(Eigen::Vector3d(p.x() - plate.margin, plate.bottom, p.y() - plate.margin));
    box.extend(Eigen::Vector3d(p.x() + plate.margin, plate.top, p.y() + plate.margin));
  }
  Stamp(grid, box, [&plate](const Eigen::Vector3d& p) { return plate.Distance(p); });
}

std::optional<Diagnostic> TooCoarse(const PrintOptions& options, double voxel_size) {
  for (const auto& wall : {options.min_wall, options.hollow}) {
    if (!wall || *wall >= kThinnestVoxels * voxel_size) continue;
    return Error(FailureKind::kUsage, "print-too-coarse",
                 fmt::format("walls of {:.3g} mm are less than two voxels of {:.3g} mm: ask for a "
                             "--resolution {:.1f} times as high, or for thicker walls",
                             *wall, voxel_size, kThinnestVoxels * voxel_size / *wall + 0.05));
  }
  return std::nullopt;
}

PreparedPrint Prepare(const NarrowBand& band, const Mesh& mesh, const PrintOptions& options,
                      const Execution& execution) {
  PrintChanges changes;
  const FloatGrid::Ptr grid = ToLevelSet(band, execution);
  if (options.min_wall) {
    changes.thickened = FindThinWalls(mesh, *options.min_wall, execution);
    Thicken(*grid, changes.thickened, *options.min_wall);
    // Where a tip was too thin to have places of its own, the balls leave gaps: once more there.
    const Mesh thicker = *ExtractMesh(*grid, execution);
    Thicken(*grid, FindThinWalls(thicker, *options.min_wall, execution), *options.min_wall);
  }
  if (options.base == Base::kWhenItFalls) {
    changes.plate = PlateUnder(mesh, band.voxel_size);
    if (changes.plate) AddPlate(*grid, *changes.plate);
  }
  if (options.hollow) changes.cavity = Hollow(*grid, *options.hollow);
  openvdb::tools::pruneLevelSet(grid->tree());
  NarrowBand prepared = ToNarrowBand(*grid, execution);
  std::vector<VoxelMask> unchanged = UnchangedCells(band, prepared);
  return {std::move(prepared), std::move(unchanged), std::move(changes)};
}

}  // namespace

Outcome<PreparedPrint> PreparePrint(const NarrowBand& band, const Mesh& mesh,
                                    const PrintOptions& options, const Execution& execution) {
  using Result = Outcome<PreparedPrint>;
  if (auto wrong = TooCoarse(options, band.voxel_size)) return Result::Failure(*std::move(wrong));
  PreparedPrint prepared;
  RunInArena(execution, [&] { prepared = Prepare(band, mesh, options, execution); });
  if (execution.IsCancelled())
    return Result::Failure(Error(FailureKind::kInterrupted, "cancelled", "the run was stopped"));
  return prepared;
}

}  // namespace lascaux

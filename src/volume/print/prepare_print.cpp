#include "lascaux/volume/prepare_print.h"

#include <fmt/format.h>
#include <openvdb/tools/ParticlesToLevelSet.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lascaux/base/arena.h"
#include "lascaux/volume/level_set.h"
#include "volume/print/hollow.h"
#include "volume/print/plate.h"
#include "volume/print/stamp.h"
#include "volume/print/unchanged_cells.h"

namespace lascaux {
namespace {

using openvdb::FloatGrid;

constexpr double kThinnestVoxels = 2;  // of a wall: its two sides must not share voxels
constexpr double kTolerance = 0.02;    // voxels that a thickened wall may lack
constexpr double kMostMore = 0.5;      // voxels by which a ball is wider than the wall it makes
constexpr int kMostRounds = 8;         // examples take two to six

/// Balls in the middle of walls, as OpenVDB wants to have them.
struct Balls {
  using PosType = openvdb::Vec3R;
  const std::vector<Wall>& walls;
  double thickness = 0;  ///< that the walls are to have
  double gain = 0;       ///< diameters are larger by that times what a wall lacks
  double most_more = 0;  ///< but by no more than this

  std::size_t size() const { return walls.size(); }
  void getPos(std::size_t i, PosType& p) const {
    p = {walls[i].middle.x(), walls[i].middle.y(), walls[i].middle.z()};
  }
  void getPosRad(std::size_t i, PosType& p, openvdb::Real& radius) const {
    getPos(i, p);
    radius = (thickness + std::min(gain * (thickness - walls[i].thickness), most_more)) / 2;
  }
};

void AddBalls(FloatGrid& grid, const Balls& balls) {
  openvdb::tools::ParticlesToLevelSet<FloatGrid> raster(grid);
  raster.setRmin(0);
  raster.rasterizeSpheres(balls);
  raster.finalize(/*prune=*/true);
}

/// Returns what is still thin. Balls on a lattice come out thinner than they are, and where a tip
/// was too thin to have places of its own, they leave gaps: so again there, with larger balls.
std::vector<Wall> Thicken(FloatGrid& grid, std::vector<Wall> walls, double thickness,
                          const Execution& execution) {
  const double voxel = grid.voxelSize().x();
  double gain = 0;
  for (int round = 0; round < kMostRounds && !walls.empty() && !execution.IsCancelled(); ++round) {
    AddBalls(grid, {walls, thickness, gain, kMostMore * voxel});
    gain = gain == 0 ? 1 : 2 * gain;
    const auto mesh = ExtractMesh(grid, execution);
    if (!mesh) break;
    walls = FindThinWalls(*mesh, thickness - kTolerance * voxel, execution);
  }
  return walls;
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
    changes.still_thin = Thicken(*grid, changes.thickened, *options.min_wall, execution);
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

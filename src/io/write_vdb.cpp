#include "lascaux/io/write_vdb.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>

#include "io/vdb_conventions.h"
#include "lascaux/base/arena.h"
#include "lascaux/io/output_file.h"
#include "lascaux/volume/narrow_band.h"

namespace lascaux {
namespace {

using Half = openvdb::math::half;
constexpr float kLargestHalf = 65504;

/// Opens the writer of io::File to streams in memory, where it can be hashed and cannot fail
/// half-way.
class MemoryArchive : public openvdb::io::Archive {
 public:
  std::string Encode(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata) {
    // Zip is for what is neither level set nor fog volume: OpenVDB leaves it out for these, whose
    // digits it hardly shortens. Colours become a twelfth.
    setCompression(openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_ZIP);
    std::ostringstream stream(std::ios::binary);
    write(stream, grids, /*seekable=*/true, metadata);
    return std::move(stream).str();
  }
};

float Stored(float value, VdbFloats floats) {
  return floats == VdbFloats::kHalf ? static_cast<float>(Half(value)) : value;
}

/// The smallest number as it is stored that is at least 3 voxels (VdbBackground).
float Background(double voxel_size, VdbFloats floats) {
  float background = VdbBackground(voxel_size);
  while (Stored(background, floats) / voxel_size < kBandVoxels)
    background = std::nextafter(background, std::numeric_limits<float>::infinity());
  return Stored(background, floats);
}

/// Multiplies distances by `factor` and sets everything outside the band to plus or minus
/// `background`.
void ScaleValues(openvdb::FloatTree& tree, double factor, float background) {
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(tree);
  leaves.foreach ([=](openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    float* values = leaf.buffer().data();
    for (openvdb::Index i = 0; i < openvdb::FloatTree::LeafNodeType::SIZE; ++i) {
      const auto scaled = static_cast<float>(factor * values[i]);
      // Rounding may carry a distance at the band's edge past the background by one bit.
      values[i] = leaf.isValueOn(i) ? std::clamp(scaled, -background, background)
                                    : std::copysign(background, values[i]);
    }
  });
  openvdb::tools::changeBackground(tree, background);
}

/// A copy of the grid in the unit of the scene.
template <typename Grid>
openvdb::GridBase::Ptr SceneGrid(const Grid& grid, const WriteVdbOptions& options) {
  const typename Grid::Ptr scene = grid.deepCopy();
  const double factor = PerMillimetre(options.unit);
  scene->transform().postScale(factor);
  if (options.floats == VdbFloats::kHalf) scene->setSaveFloatAsHalf(true);
  if constexpr (std::is_same_v<Grid, openvdb::FloatGrid>) {
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET)
      ScaleValues(scene->tree(), factor, Background(scene->voxelSize().x(), options.floats));
  }
  return scene;
}

openvdb::GridCPtrVec SceneGrids(const openvdb::GridCPtrVec& grids, const WriteVdbOptions& options) {
  openvdb::GridCPtrVec scene;
  for (const openvdb::GridBase::ConstPtr& grid : grids) {
    const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid);
    const auto copy =
        floats ? SceneGrid(*floats, options)
               : SceneGrid(*openvdb::gridConstPtrCast<openvdb::Vec3SGrid>(grid), options);
    if (scene.empty()) copy->setName("surface");
    scene.push_back(copy);
  }
  return scene;
}

openvdb::MetaMap FileMetadata(const WriteVdbOptions& options) {
  openvdb::MetaMap metadata;
  metadata.insertMeta("units", openvdb::StringMetadata(Name(options.unit)));
  metadata.insertMeta("up_axis", openvdb::StringMetadata(Name(options.up)));
  for (const auto& [key, value] : options.metadata) {
    metadata.insertMeta(key, openvdb::StringMetadata(value));
  }
  return metadata;
}

Diagnostic VoxelTooLarge(const std::filesystem::path& path, double voxel_size, Unit unit) {
  return Error(FailureKind::kOutput, "voxel-too-large",
               fmt::format("cannot write '{}': three voxels of {:.3g} mm in units of {} are more "
                           "than 16 bits hold ({}); leave --half out, or use --units m",
                           path.string(), voxel_size, Name(unit), kLargestHalf));
}

}  // namespace

Diagnostics WriteVdb(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
                     const WriteVdbOptions& options, const Execution& execution) {
  const double voxel_size = grids.front()->voxelSize().x();
  const double scene_size = voxel_size * PerMillimetre(options.unit);
  if (Diagnostics error = CheckVdbVoxelSize(path, voxel_size, options.unit); !error.empty())
    return error;
  if (options.floats == VdbFloats::kHalf && kBandVoxels * scene_size > kLargestHalf)
    return {VoxelTooLarge(path, voxel_size, options.unit)};
  std::string bytes;
  try {
    openvdb::initialize();
    RunInArena(execution, [&] {
      bytes = MemoryArchive().Encode(SceneGrids(grids, options), FileMetadata(options));
    });
  } catch (const std::exception& error) {
    return {Error(
        FailureKind::kOutput, "cannot-write",
        fmt::format("cannot write '{}': {}; lower the resolution", path.string(), error.what()))};
  }
  SetVdbId(bytes);
  return WriteBytes(path, bytes);
}

Diagnostics WriteVdb(const std::filesystem::path& path, const openvdb::FloatGrid& grid,
                     const WriteVdbOptions& options, const Execution& execution) {
  const openvdb::GridBase::ConstPtr borrowed(openvdb::GridBase::ConstPtr(), &grid);
  return WriteVdb(path, openvdb::GridCPtrVec{borrowed}, options, execution);
}

}  // namespace lascaux

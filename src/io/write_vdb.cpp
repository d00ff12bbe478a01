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

#include "io/file_writer.h"
#include "lascaux/io/content_hash.h"
#include "lascaux/io/output_file.h"
#include "volume/arena.h"

namespace lascaux {
namespace {

constexpr double kBandVoxels = 3;  // half width that tools::checkLevelSet asks for

/// Maps whose determinant is below this are refused by OpenVDB: three times its Tolerance<double>.
constexpr double kSmallestDeterminant = 3e-15;

// Where the random id stands in a file: after the magic number, the versions and the flag for
// offsets.
constexpr std::size_t kIdOffset = 21, kIdLength = 36;

/// Opens the writer of io::File to streams in memory, where it can be hashed and cannot fail
/// half-way.
class MemoryArchive : public openvdb::io::Archive {
 public:
  std::string Encode(const openvdb::GridBase::ConstPtr& grid, const openvdb::MetaMap& metadata) {
    setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    std::ostringstream stream(std::ios::binary);
    write(stream, openvdb::GridCPtrVec{grid}, /*seekable=*/true, metadata);
    return std::move(stream).str();
  }
};

/// The smallest float that is at least 3 voxels when divided by the voxel size in double precision.
float Background(double voxel_size) {
  auto background = static_cast<float>(kBandVoxels * voxel_size);
  while (background / voxel_size < kBandVoxels) {
    background = std::nextafter(background, std::numeric_limits<float>::infinity());
  }
  return background;
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
openvdb::FloatGrid::Ptr SceneGrid(const openvdb::FloatGrid& grid, Unit unit) {
  const auto tree = std::make_shared<openvdb::FloatTree>(grid.tree());
  const auto scene = openvdb::FloatGrid::create(tree);
  const auto transform = grid.transform().copy();
  transform->postScale(PerMillimetre(unit));
  scene->setTransform(transform);
  scene->setName("surface");
  scene->setGridClass(openvdb::GRID_LEVEL_SET);
  ScaleValues(*tree, PerMillimetre(unit), Background(scene->voxelSize().x()));
  return scene;
}

openvdb::MetaMap FileMetadata(const WriteVdbOptions& options) {
  openvdb::MetaMap metadata;
  metadata.insertMeta("units", openvdb::StringMetadata(Name(options.unit)));
  metadata.insertMeta("up_axis", openvdb::StringMetadata("Y"));
  for (const auto& [key, value] : options.metadata) {
    metadata.insertMeta(key, openvdb::StringMetadata(value));
  }
  return metadata;
}

/// Replaces the random id by one in the same form that is hashed from everything else.
void SetId(std::string& bytes) {
  bytes.replace(kIdOffset, kIdLength, kIdLength, '0');
  std::string id = ContentHashText(bytes);
  for (const unsigned dash : {8U, 13U, 18U, 23U}) id.insert(dash, 1, '-');
  bytes.replace(kIdOffset, kIdLength, id);
}

Diagnostic VoxelTooSmall(const std::filesystem::path& path, double voxel_size, Unit unit) {
  return Error(FailureKind::kOutput, "voxel-too-small",
               fmt::format("cannot write '{}': OpenVDB refuses voxels of {:.3g} mm in units of {} "
                           "(least {:.3g} mm); use --units mm, a larger --size or a lower "
                           "--resolution",
                           path.string(), voxel_size, Name(unit),
                           std::cbrt(kSmallestDeterminant) / PerMillimetre(unit)));
}

}  // namespace

Diagnostics WriteVdb(const std::filesystem::path& path, const openvdb::FloatGrid& grid,
                     const WriteVdbOptions& options, const Execution& execution) {
  const double voxel_size = grid.voxelSize().x();
  // OpenVDB scales first and multiplies the three sides then: the limit is taken a hair wider than
  // it does.
  if (std::pow(voxel_size * PerMillimetre(options.unit), 3) < kSmallestDeterminant * (1 + 1e-9)) {
    return {VoxelTooSmall(path, voxel_size, options.unit)};
  }
  std::string bytes;
  try {
    openvdb::initialize();
    RunInArena(execution, [&] {
      bytes = MemoryArchive().Encode(SceneGrid(grid, options.unit), FileMetadata(options));
    });
  } catch (const std::exception& error) {
    return {Error(
        FailureKind::kOutput, "cannot-write",
        fmt::format("cannot write '{}': {}; lower the resolution", path.string(), error.what()))};
  }
  SetId(bytes);
  return WriteBytes(path, bytes);
}

}  // namespace lascaux

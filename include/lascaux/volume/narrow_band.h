#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/field/field.h"
#include "lascaux/volume/voxel_floats.h"

/// @file
/// A field as a narrow-band level set in plain values: what OpenVDB's grid holds (level_set.h turns
/// one into the other) without the library, which takes longer to load than most models to make.

namespace lascaux {

/// Half width of the band in voxels: what OpenVDB's tools expect of a level set.
inline constexpr int kBandVoxels = 3;

/// Voxel sizes outside of these are refused: OpenVDB takes the cube of smaller ones for 0, and the
/// field farther from the origin than this many voxels would lose its digits in single precision.
inline constexpr double kLeastVoxelSize = 2e-5, kLargestVoxelSize = 1e9;
inline constexpr int kFarthestVoxel = 30'000;

/// Voxels along a block's side: a leaf of OpenVDB's tree.
inline constexpr int kBlockSide = 8;
inline constexpr std::size_t kBlockVoxels = 512;

/// One bit a voxel, one word for each x: bit 8 y + z.
using VoxelMask = std::array<std::uint64_t, 8>;

/// A cube of voxels without surface.
struct Cube {
  Eigen::Vector3i origin = Eigen::Vector3i::Zero();  ///< its lowest voxel
  int side = 0;
};

/// Signed distances, negative inside, around a surface.
///
/// Blocks of 8 x 8 x 8 voxels hold all voxels of the band; what is in no block is at -background in
/// `inside` and at background elsewhere. A block that is missing beside another is on the same side
/// as the voxels that it would touch.
struct NarrowBand {
  double voxel_size = 1;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< place of the centre of voxel (0, 0, 0)
  float background = kBandVoxels;
  std::vector<Eigen::Vector3i> blocks;  ///< lowest voxel of each, multiples of 8, all different
  VoxelFloats values;             ///< kBlockVoxels a block, voxel (x, y, z) of it at 64 x + 8 y + z
  std::vector<VoxelMask> active;  ///< voxels of the band, for each block
  std::vector<Cube> inside;       ///< sides and origins are multiples of 8

  std::size_t size() const noexcept { return blocks.size(); }
};

/// Voxels in the band.
std::int64_t CountActive(const NarrowBand& band);

struct RasteriseOptions {
  double voxel_size = 0;  ///< in the field's unit, > 0

  bool operator==(const RasteriseOptions&) const = default;
};

/// The signed distance to F = 1, in the field's unit; background the smallest float that is at
/// least 3 voxels.
///
/// The plane z = 0 runs through voxel centres. A field whose parts have exact mirror images is
/// evaluated on one side and mirrored, so that its band is symmetric bit by bit. Same bits for any
/// number of threads.
///
/// Blocks that may hold surface are found from bounds, so none is missed and memory grows with the
/// surface. Distances are by Newton's method beside the surface; beyond, by Godunov's scheme for
/// |grad d| = 1, corrected to the distance from the tangent plane at the foot. Spheres and
/// cylinders with a radius of 8 voxels: mean error 0.001 voxel, largest 0.02; the error in voxels
/// falls at least as fast as the voxels. In creases, where that plane is not the nearest surface,
/// the scheme's first order remains. No distance is smaller than 0.004 voxel.
///
/// Errors: "bad-voxel-size", "bad-primitive" (from Validate), "empty-field" (no voxel centre is
/// inside), "out-of-memory" (with the estimate: EstimateBytes(), or where that is too much, a
/// closer one from the blocks of a coarser grid, in some tens of milliseconds), "cancelled".
Outcome<NarrowBand> RasteriseBand(const Field& field, const RasteriseOptions& options,
                                  const Execution& execution = {});

/// Bytes that RasteriseBand and ExtractMesh will need at most, estimated from the primitives' sizes
/// before any work. The field and the voxel size must be valid.
std::size_t EstimateBytes(const Field& field, const RasteriseOptions& options);

}  // namespace lascaux

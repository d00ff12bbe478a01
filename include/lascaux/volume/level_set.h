#pragma once

#include <openvdb/openvdb.h>

#include <cstddef>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/field/field.h"

/// @file
/// A field as a narrow-band level set.

namespace lascaux {

/// Half width of the band in voxels: what OpenVDB's tools expect of a level set.
inline constexpr int kBandVoxels = 3;

/// Voxel sizes outside of these are refused: OpenVDB takes the cube of smaller ones for 0, and the
/// field farther from the origin than this many voxels would lose its digits in single precision.
inline constexpr double kLeastVoxelSize = 2e-5, kLargestVoxelSize = 1e9;
inline constexpr int kFarthestVoxel = 30'000;

struct RasteriseOptions {
  double voxel_size = 0;  ///< in the field's unit, > 0

  bool operator==(const RasteriseOptions&) const = default;
};

/// The signed distance to F = 1, negative inside, in the field's unit: a level set by OpenVDB's
/// rules (class, background the smallest float that is at least 3 voxels, inactive interior at
/// minus that, no active tiles, uniform scale), named "surface".
///
/// The plane z = 0 runs through voxel centres. A field whose parts have exact mirror images is
/// evaluated on one side and mirrored, so that its grid is symmetric bit by bit. Same bits for any
/// number of threads.
///
/// Blocks of 8 x 8 x 8 voxels that may hold surface are found from bounds, so none is missed and
/// memory grows with the surface. Distances are by Newton's method beside the surface; beyond, by
/// Godunov's scheme for |grad d| = 1, corrected to the distance from the tangent plane at the foot.
/// Spheres and cylinders with a radius of 8 voxels: mean error 0.001 voxel, largest 0.02; the error
/// in voxels falls at least as fast as the voxels. In creases, where that plane is not the nearest
/// surface, the scheme's first order remains. No distance is smaller than 0.004 voxel.
///
/// Errors: "bad-voxel-size", "bad-primitive" (from Validate), "empty-field" (no voxel centre is
/// inside), "out-of-memory" (with the estimate), "cancelled".
Outcome<openvdb::FloatGrid::Ptr> Rasterise(const Field& field, const RasteriseOptions& options,
                                           const Execution& execution = {});

/// Bytes that Rasterise and ExtractMesh will need at most, estimated from the primitives' sizes
/// before any work. The field and the voxel size must be valid.
std::size_t EstimateBytes(const Field& field, const RasteriseOptions& options);

}  // namespace lascaux

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

struct RasteriseOptions {
  double voxel_size = 0;  ///< in the field's unit, > 0

  bool operator==(const RasteriseOptions&) const = default;
};

/// The signed distance to F = 1, negative inside, in the field's unit: a level set by OpenVDB's rules (class, background exactly
/// 3 voxels, inactive interior at minus that, no active tiles, uniform scale).
///
/// The plane z = 0 runs through voxel centres, so that a symmetric field gives a symmetric grid. Same bits for any
/// number of threads. Errors: "empty-field", "out-of-memory" (with the estimate), "cancelled".
Outcome<openvdb::FloatGrid::Ptr> Rasterise(const Field& field, const RasteriseOptions& options,
                                           const Execution& execution = {});

/// Bytes that Rasterise and ExtractMesh will need at most, estimated from the field's bounds before any work.
std::size_t EstimateBytes(const Field& field, const RasteriseOptions& options);

}  // namespace lascaux

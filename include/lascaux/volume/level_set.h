#pragma once

#include <openvdb/openvdb.h>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/field/field.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/narrow_band.h"

/// @file
/// Narrow bands as OpenVDB's grids.

namespace lascaux {

/// The band as a level set by OpenVDB's rules (class, inactive interior at -background, no active
/// tiles, uniform scale), named "surface".
openvdb::FloatGrid::Ptr ToLevelSet(const NarrowBand& band, const Execution& execution = {});

/// A level set as a band; its transform must be a uniform scale with a translation. Tiles beside
/// leaves with another sign become blocks.
NarrowBand ToNarrowBand(const openvdb::FloatGrid& grid, const Execution& execution = {});

/// ToLevelSet of RasteriseBand, with its errors.
Outcome<openvdb::FloatGrid::Ptr> Rasterise(const Field& field, const RasteriseOptions& options,
                                           const Execution& execution = {});

/// ExtractMesh of ToNarrowBand (extract_mesh.h).
Outcome<Mesh> ExtractMesh(const openvdb::FloatGrid& grid, const Execution& execution = {});

}  // namespace lascaux

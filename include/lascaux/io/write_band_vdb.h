#pragma once

#include <filesystem>

#include "lascaux/base/diagnostic.h"
#include "lascaux/io/write_vdb_options.h"
#include "lascaux/volume/narrow_band.h"

/// @file
/// The level set as an OpenVDB file, without OpenVDB: to load the library takes longer than to make
/// and to write the level set of most models.

namespace lascaux {

/// Writes a level set in millimetres as the grid "surface": what WriteVdb() (write_vdb.h) writes of
/// ToLevelSet(band), by the same rules and with the same errors; a test has OpenVDB read both. Only
/// the index for delayed loading is left out, which OpenVDB does without.
///
/// options.floats must be kFull. The same band and options give the same bytes. About 1 GB/s,
/// and little memory: leaves are written piece by piece. The path must be of a file that can be
/// written to anywhere, not of a pipe.
Diagnostics WriteBandVdb(const std::filesystem::path& path, const NarrowBand& band,
                         const WriteVdbOptions& options = {});

}  // namespace lascaux

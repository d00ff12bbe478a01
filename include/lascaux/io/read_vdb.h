#pragma once

#include <openvdb/openvdb.h>

#include <string>
#include <string_view>

#include "lascaux/base/outcome.h"

/// @file
/// Level sets from OpenVDB files.

namespace lascaux {

struct ReadVdbOptions {
  std::string grid;     ///< name of the level set; empty: "surface" or else the first
  bool colors = false;  ///< the grids of colours and parts, too

  bool operator==(const ReadVdbOptions&) const = default;
};

/// A level set, y up, with what its file says of it.
struct VdbModel {
  openvdb::FloatGrid::Ptr surface;  ///< never empty
  openvdb::Vec3SGrid::Ptr color;    ///< "Cd", if it was asked for and is there
  openvdb::FloatGrid::Ptr part;     ///< "part", likewise
  openvdb::MetaMap metadata;        ///< the file's
};

/// Reads one level set of an OpenVDB file or stream, whoever wrote it. Other grids are skipped, if
/// the file says where they end.
///
/// The level set is of floats (also when saved as half), has active voxels, a positive background
/// and finite values, and a transform of one scale and a translation: what Render() asks for. A
/// file with the metadata "up_axis" = "Z" is turned to y up. Bytes of any kind are an outcome; a
/// damaged length in them may cost as much memory as it says.
///
/// Errors, all of kind kInput: "not-vdb" (not OpenVDB, or damaged, with OpenVDB's own words),
/// "not-level-set" (the file has none, or none of this name; what there is is listed),
/// "bad-transform", "bad-level-set" (values that are no distances), "too-large" (more than 32768
/// voxels along a side), "empty-grid".
Outcome<VdbModel> ReadVdb(std::string_view bytes, const ReadVdbOptions& options = {});

}  // namespace lascaux

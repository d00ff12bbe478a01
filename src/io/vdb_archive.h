#pragma once

#include <openvdb/openvdb.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lascaux {

/// What a file says of a grid before the grid itself.
struct VdbEntry {
  std::string name;
  std::string type;             ///< of its values, such as "float"
  openvdb::GridBase::Ptr grid;  ///< empty until it is read
};

/// An OpenVDB file in memory: what is in it, and the grids that are asked for.
///
/// openvdb::io::File reads from paths alone, and openvdb::io::Stream reads all grids. Neither sees
/// the end of a file that is cut off: here it is an exception.
struct VdbContents {
  openvdb::MetaMap metadata;
  std::vector<VdbEntry> entries;
};

/// Reads the grids for which `wants` is true; it is asked in the file's order. Throws what OpenVDB
/// and streams throw.
VdbContents ReadVdbContents(std::string_view bytes,
                            const std::function<bool(const VdbEntry&)>& wants);

}  // namespace lascaux

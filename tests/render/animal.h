#pragma once

#include <openvdb/openvdb.h>

namespace lascaux {

/// A four-legged body of blended cones with head, ears and tail, 100 mm long, standing on y = 0 and
/// looking along +x.
///
/// A level set by OpenVDB's rules up to |gradient|, `voxels` along its length.
openvdb::FloatGrid::Ptr Animal(int voxels);

/// The same, looking along -x.
openvdb::FloatGrid::Ptr AnimalTurned(int voxels);

}  // namespace lascaux

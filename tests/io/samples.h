#pragma once

#include <openvdb/openvdb.h>

#include "lascaux/volume/image.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"
#include "lascaux/volume/picture.h"

namespace lascaux {

inline constexpr double kSampleRadius = 20;  // mm

/// A sphere of radius 20 mm around (5, 20, -3), so that it stands on y = 0: 8 * 4^n triangles of a
/// refined octahedron.
Mesh SampleSphere(int refinements);

/// Its normals and two parts: "body" below the middle, "limb-1" above.
MeshDetails SampleDetails(const Mesh& mesh);

/// Its level set with voxels of `voxel_size` mm.
openvdb::FloatGrid::Ptr SampleLevelSet(double voxel_size);

/// Every channel different at every pixel, with all alphas.
Image SamplePicture(int width, int height);

/// Light and all layers, each a function of the place: check_formats.py knows it.
Picture SampleLayers(int width, int height);

}  // namespace lascaux

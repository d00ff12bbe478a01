#pragma once

#include <cstdint>

#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh.h"

namespace lascaux::testing {

/// A sphere made of an octahedron whose faces are cut in four `levels` times; outward.
Mesh Sphere(int levels, float radius = 1);

/// A torus around the y axis: n x n quads, each cut in two; outward.
Mesh Torus(std::uint32_t n, float major = 2, float minor = 0.7F);

/// The tetrahedron with corners at the origin and on the three axes; outward.
Mesh Tetrahedron();

/// The same mesh moved by (x, y, z).
Mesh Moved(Mesh mesh, float x, float y, float z);

/// Both meshes in one, without a common vertex.
Mesh Together(Mesh mesh, const Mesh& other);

/// All triangles turned over.
Mesh InsideOut(Mesh mesh);

/// Executions that differ from the usual one.
Execution OnThreads(int threads);
Execution CancelledBy(const std::atomic<bool>& cancel);

}  // namespace lascaux::testing

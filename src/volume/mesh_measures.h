#pragma once

#include <array>
#include <cstdint>

#include "lascaux/volume/mesh.h"

namespace lascaux {

/// Middle of the box around a mesh: seen from there, the tetrahedra that add up to its volume are
/// small.
Eigen::Vector3d MiddleOf(const Mesh& mesh);

/// Six times the volume of the tetrahedron between a triangle and a point.
double SixVolumes(const Mesh& mesh, const std::array<std::uint32_t, 3>& t,
                  const Eigen::Vector3d& point);

/// The volume alone, and with the area; the same bits for any number of threads.
double VolumeOf(const Mesh& mesh);
struct MeshMeasures {
  double volume = 0, area = 0;
};
MeshMeasures MeasureTriangles(const Mesh& mesh);

}  // namespace lascaux

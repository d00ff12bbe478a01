#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lascaux/io/units.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"

namespace lascaux {

/// A vertex in another unit than millimetres, each coordinate multiplied in double precision and
/// rounded once.
inline Eigen::Vector3f SceneVertex(const Eigen::Vector3f& vertex, double per_millimetre) {
  return (per_millimetre * vertex.cast<double>()).cast<float>();
}

/// All of a mesh's.
inline std::vector<Eigen::Vector3f> SceneVertices(const Mesh& mesh, Unit unit) {
  const double factor = PerMillimetre(unit);
  std::vector<Eigen::Vector3f> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Eigen::Vector3f& v : mesh.vertices) vertices.push_back(SceneVertex(v, factor));
  return vertices;
}

/// The model's axes to the print frame's: X = x, Y = -z, Z = y. 0 - z and not -z, which would write
/// a zero as minus zero.
inline Eigen::Vector3f ToPrintFrame(const Eigen::Vector3f& p) {
  return {p.x(), 0.0F - p.z(), p.y()};
}

/// For each part its triangles, in their order.
inline std::vector<std::vector<std::uint32_t>> TrianglesOfParts(const MeshDetails& details) {
  std::vector<std::vector<std::uint32_t>> groups(details.parts.size());
  for (std::uint32_t t = 0; t < details.triangle_parts.size(); ++t)
    groups[details.triangle_parts[t]].push_back(t);
  return groups;
}

}  // namespace lascaux

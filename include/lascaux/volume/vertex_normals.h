#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/field/field.h"
#include "lascaux/volume/mesh.h"

/// @file
/// Normals at a mesh's vertices.

namespace lascaux {

/// Means of the faces' normals weighted by area, of length 1; (0, 0, 0) for a vertex in no face
/// with area.
std::vector<Eigen::Vector3f> VertexNormals(const Mesh& mesh);

/// Directions against the field's gradient, of length 1: smoother than the mesh, whose faces follow
/// the voxels.
///
/// The mesh's own, where it knows them; else those of the field at the vertices, `offset` added.
/// Where the gradient is more than 60 degrees from the faces' mean (in creases) or not known, that
/// mean is taken. About 0.2 us a vertex where they have to be found, 0.02 us else.
std::vector<Eigen::Vector3f> FieldNormals(const Mesh& mesh, const Field& field,
                                          const Eigen::Vector3d& offset,
                                          const Execution& execution = {});

/// The same in the memory of those that the mesh knows, which it has no more then.
std::vector<Eigen::Vector3f> TakeFieldNormals(Mesh& mesh, const Field& field,
                                              const Eigen::Vector3d& offset,
                                              const Execution& execution = {});

}  // namespace lascaux

#include "lascaux/volume/vertex_normals.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <span>

#include "lascaux/field/compiled_field.h"
#include "volume/arena.h"
#include "volume/point_cells.h"

namespace lascaux {

std::vector<Eigen::Vector3f> VertexNormals(const Mesh& mesh) {
  // Sums of cross products, whose lengths are twice the areas.
  std::vector<Eigen::Vector3d> sums(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d cross =
        (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin);
    for (const std::uint32_t corner : {a, b, c}) sums[corner] += cross;
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(sums.size());
  // stableNormalized() leaves a zero vector zero.
  for (const Eigen::Vector3d& sum : sums)
    normals.emplace_back(sum.stableNormalized().cast<float>());
  return normals;
}

std::vector<Eigen::Vector3f> FieldNormals(const Mesh& mesh, const Field& field,
                                          const Eigen::Vector3d& offset,
                                          const Execution& execution) {
  constexpr float kFarthest = 0.5F;  // cosine of 60 degrees
  std::vector<Eigen::Vector3f> normals = VertexNormals(mesh);
  const CompiledField compiled(field);
  const PointCells cells(mesh.vertices);
  const auto smooth = [&](std::size_t cell) {
    const std::span<const std::uint32_t> which = cells.Points(cell);
    const CellBlock block(mesh.vertices, which, offset);
    const ActiveSet active = compiled.BoundOnBall(block.ball, compiled.All()).active;
    std::vector<float> value(which.size()), x(which.size()), y(which.size()), z(which.size());
    compiled.EvaluateSamples(block.Points(), active, {value, x, y, z});
    for (std::size_t i = 0; i < which.size(); ++i) {
      const Eigen::Vector3f outward = -Eigen::Vector3f(x[i], y[i], z[i]);
      const float length = outward.norm();
      Eigen::Vector3f& normal = normals[which[i]];
      if (outward.dot(normal) > kFarthest * length) normal = outward / length;
    }
  };
  RunInArena(execution, [&] { tbb::parallel_for(std::size_t{0}, cells.count(), smooth); });
  return normals;
}

}  // namespace lascaux

#include "volume/mesh_measures.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <functional>

namespace lascaux {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kGrain = 4096;  // triangles a task

}  // namespace

Vector3d MiddleOf(const Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& v : mesh.vertices) box.extend(v);
  return box.cast<double>().center();
}

double SixVolumes(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, const Vector3d& point) {
  const Vector3d a = mesh.vertices[t[0]].cast<double>() - point;
  const Vector3d b = mesh.vertices[t[1]].cast<double>() - point;
  const Vector3d c = mesh.vertices[t[2]].cast<double>() - point;
  return a.dot(b.cross(c));
}

double VolumeOf(const Mesh& mesh) {
  const Vector3d middle = MiddleOf(mesh);
  const auto add = [&](const tbb::blocked_range<std::size_t>& range, double sum) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      sum += SixVolumes(mesh, mesh.triangles[i], middle);
    return sum;
  };
  return tbb::parallel_deterministic_reduce(
             tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kGrain), 0.0, add,
             std::plus<>()) /
         6;
}

MeshMeasures MeasureTriangles(const Mesh& mesh) {
  const Vector3d middle = MiddleOf(mesh);
  const auto add = [&](const tbb::blocked_range<std::size_t>& range, MeshMeasures sum) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const auto& t = mesh.triangles[i];
      const Vector3d a = mesh.vertices[t[0]].cast<double>() - middle;
      const Vector3d b = mesh.vertices[t[1]].cast<double>() - middle;
      const Vector3d c = mesh.vertices[t[2]].cast<double>() - middle;
      sum.volume += a.dot(b.cross(c)) / 6;
      sum.area += (b - a).cross(c - a).norm() / 2;
    }
    return sum;
  };
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kGrain), MeshMeasures{}, add,
      [](const MeshMeasures& a, const MeshMeasures& b) {
        return MeshMeasures{a.volume + b.volume, a.area + b.area};
      });
}

}  // namespace lascaux

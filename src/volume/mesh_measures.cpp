#include "volume/mesh_measures.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

namespace lascaux {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kGrain = 4096;  // triangles or vertices a task

}  // namespace

Vector3d MiddleOf(const Mesh& mesh) {
  using Box = Eigen::AlignedBox3f;
  const auto extend = [&](const tbb::blocked_range<std::size_t>& range, Box box) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) box.extend(mesh.vertices[v]);
    return box;
  };
  const Box box =
      tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, mesh.vertices.size(), kGrain), Box(),
                           extend, [](const Box& a, const Box& b) { return a.merged(b); });
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
    double volumes = 0, areas = 0;  // six times the one, twice the other
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const auto& t = mesh.triangles[i];
      const Vector3d a = mesh.vertices[t[0]].cast<double>() - middle;
      const Vector3d b = mesh.vertices[t[1]].cast<double>() - middle;
      const Vector3d c = mesh.vertices[t[2]].cast<double>() - middle;
      const Vector3d across = (b - a).cross(c - a);
      volumes += a.dot(across);
      areas += std::sqrt(across.squaredNorm());
    }
    return MeshMeasures{sum.volume + volumes / 6, sum.area + areas / 2};
  };
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kGrain), MeshMeasures{}, add,
      [](const MeshMeasures& a, const MeshMeasures& b) {
        return MeshMeasures{a.volume + b.volume, a.area + b.area};
      });
}

}  // namespace lascaux

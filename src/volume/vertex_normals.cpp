#include "lascaux/volume/vertex_normals.h"

#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <span>
#include <utility>

#include "lascaux/base/arena.h"
#include "lascaux/field/compiled_field.h"
#include "volume/four.h"
#include "volume/point_runs.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Triangle = std::array<std::uint32_t, 3>;

constexpr float kFarthest = 0.5F;  // cosine of 60 degrees

/// Twice the area, across the triangle.
template <typename T>
Eigen::Vector3<T> CrossOf(const Mesh& mesh, const Triangle& t) {
  const Eigen::Vector3<T> origin = mesh.vertices[t[0]].cast<T>();
  return (mesh.vertices[t[1]].cast<T>() - origin).cross(mesh.vertices[t[2]].cast<T>() - origin);
}

/// Directions against the gradient at the vertices.
std::vector<Vector3f> OutwardOf(const Mesh& mesh, const Field& field, const Vector3d& offset) {
  std::vector<Vector3f> outward(mesh.vertices.size());
  const CompiledField compiled(field);
  const PointRuns runs(mesh.vertices);
  tbb::parallel_for(std::size_t{0}, runs.count(), [&](std::size_t run) {
    const std::size_t first = runs.First(run), count = runs.First(run + 1) - first;
    const RunBlock block(std::span(mesh.vertices).subspan(first, count), offset);
    const ActiveSet active = compiled.BoundOnBall(block.ball, compiled.All()).active;
    std::vector<float> value(count), x(count), y(count), z(count);
    compiled.EvaluateSamples(block.Points(), active, {value, x, y, z});
    for (std::size_t i = 0; i < count; ++i)
      outward[first + i] = -Vector3f(x[i], y[i], z[i]).stableNormalized();
  });
  return outward;
}

/// Four triangles from one on; those that are not there are the last.
class FourTriangles {
 public:
  FourTriangles(const Mesh& mesh, std::size_t first) {
    for (std::size_t k = 0; k < 4; ++k)
      triangles_[k] = &mesh.triangles[std::min(first + k, mesh.triangles.size() - 1)];
    const FourPoints p = CornersOf(mesh.vertices, 0), q = CornersOf(mesh.vertices, 1),
                     r = CornersOf(mesh.vertices, 2);
    const Four ux = q.x - p.x, uy = q.y - p.y, uz = q.z - p.z;
    const Four vx = r.x - p.x, vy = r.y - p.y, vz = r.z - p.z;
    cross_ = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
  }

  std::uint32_t Vertex(std::size_t k, std::size_t corner) const { return (*triangles_[k])[corner]; }

  /// For each corner, where the cosine between its normal and its triangle's is above `least`.
  std::array<FourInts, 3> AreNear(const std::vector<Vector3f>& normals, float least) const {
    const Four length = least * Root(Dot(cross_, cross_));
    std::array<FourInts, 3> are_near;
    for (std::size_t corner = 0; corner < 3; ++corner)
      are_near[corner] = Dot(cross_, CornersOf(normals, corner)) > length;
    return are_near;
  }

 private:
  static Four Dot(const FourPoints& a, const FourPoints& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  FourPoints CornersOf(const std::vector<Vector3f>& of, std::size_t corner) const {
    const auto at = [&](std::size_t k) { return of[Vertex(k, corner)].data(); };
    return Gather<const float>({at(0), at(1), at(2), at(3)});
  }

  std::array<const Triangle*, 4> triangles_;
  FourPoints cross_;
};

/// Turns what is more than 60 degrees from the faces' mean to that mean.
void TurnToFaces(const Mesh& mesh, std::vector<Vector3f>& normals) {
  // Where all faces are within 60 degrees, their mean is; they are looked at in single precision.
  constexpr float kSurely = kFarthest + 1e-3F;
  std::vector<std::atomic<std::uint8_t>> is_far(normals.size());
  const auto is_any_far = [&](const Triangle& t) {
    const auto far = [&](std::uint32_t v) { return is_far[v].load(std::memory_order_relaxed); };
    return (far(t[0]) | far(t[1]) | far(t[2])) != 0;
  };
  tbb::parallel_for(std::size_t{0}, (mesh.triangles.size() + 3) / 4, [&](std::size_t i) {
    const FourTriangles four(mesh, 4 * i);
    const std::array<FourInts, 3> are_near = four.AreNear(normals, kSurely);
    if (AreAll(are_near[0] & are_near[1] & are_near[2])) return;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t k = 0; k < 4; ++k)
        if (are_near[corner][k] == 0)
          is_far[four.Vertex(k, corner)].store(1, std::memory_order_relaxed);
    }
  });
  tbb::combinable<std::vector<std::uint32_t>> found;
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    if (is_any_far(mesh.triangles[i])) found.local().push_back(static_cast<std::uint32_t>(i));
  });
  std::vector<std::uint32_t> triangles;
  found.combine_each([&](const std::vector<std::uint32_t>& some) {
    triangles.insert(triangles.end(), some.begin(), some.end());
  });
  std::sort(triangles.begin(), triangles.end());
  std::map<std::uint32_t, Vector3d> sums;
  for (const std::uint32_t i : triangles) {
    const Vector3d cross = CrossOf<double>(mesh, mesh.triangles[i]);
    for (const std::uint32_t v : mesh.triangles[i])
      if (is_far[v].load(std::memory_order_relaxed) != 0)
        sums.try_emplace(v, Vector3d::Zero()).first->second += cross;
  }
  for (const auto& [v, sum] : sums) {
    const Vector3f mean = sum.stableNormalized().cast<float>();
    if (!(normals[v].dot(mean) > kFarthest)) normals[v] = mean;
  }
}

/// Where normals are wanted.
struct Surface {
  const Mesh& mesh;
  const Field& field;
  const Vector3d& offset;
};

std::vector<Vector3f> Complete(std::vector<Vector3f> normals, const Surface& of,
                               const Execution& execution) {
  RunInArena(execution, [&] {
    if (normals.empty()) normals = OutwardOf(of.mesh, of.field, of.offset);
    TurnToFaces(of.mesh, normals);
  });
  return normals;
}

}  // namespace

std::vector<Vector3f> VertexNormals(const Mesh& mesh) {
  std::vector<Vector3d> sums(mesh.vertices.size(), Vector3d::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Vector3d cross = CrossOf<double>(mesh, t);
    for (const std::uint32_t corner : t) sums[corner] += cross;
  }
  std::vector<Vector3f> normals;
  normals.reserve(sums.size());
  // stableNormalized() leaves a zero vector zero.
  for (const Vector3d& sum : sums) normals.emplace_back(sum.stableNormalized().cast<float>());
  return normals;
}

std::vector<Vector3f> FieldNormals(const Mesh& mesh, const Field& field, const Vector3d& offset,
                                   const Execution& execution) {
  return Complete(mesh.outward, {mesh, field, offset}, execution);
}

std::vector<Vector3f> TakeFieldNormals(Mesh& mesh, const Field& field, const Vector3d& offset,
                                       const Execution& execution) {
  return Complete(std::exchange(mesh.outward, {}), {mesh, field, offset}, execution);
}

}  // namespace lascaux

#include "lascaux/volume/simplify.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "lascaux/volume/check_mesh.h"

namespace lascaux {
namespace {

namespace Simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// By how much more triangles it is tried again.
constexpr double kMore = 1.25;

/// None where a face does not fit to the others.
std::optional<Surface> ToSurface(const Mesh& mesh) {
  Surface surface;
  const auto vertices = static_cast<Surface::size_type>(mesh.vertices.size());
  const auto faces = static_cast<Surface::size_type>(mesh.triangles.size());
  surface.reserve(vertices, 3 * faces / 2, faces);
  for (const Eigen::Vector3f& v : mesh.vertices)
    surface.add_vertex(
        {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())});
  using Vertex = Surface::Vertex_index;
  for (const auto& t : mesh.triangles)
    if (surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == Surface::null_face())
      return std::nullopt;
  return surface;
}

Mesh ToMesh(Surface surface) {
  surface.collect_garbage();
  Mesh mesh;
  for (const auto v : surface.vertices()) {
    const Kernel::Point_3& p = surface.point(v);
    mesh.vertices.push_back(Eigen::Vector3d(p.x(), p.y(), p.z()).cast<float>());
  }
  for (const auto f : surface.faces()) {
    auto& triangle = mesh.triangles.emplace_back();
    std::size_t corner = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
      triangle[corner++] = static_cast<std::uint32_t>(v);
  }
  return mesh;
}

Mesh Collapse(Surface surface, std::size_t faces) {
  const Simplification::GarlandHeckbert_plane_policies<Surface, Kernel> policies(surface);
  const Simplification::Bounded_normal_change_filter<> filter;
  // A closed surface has three edges for each two triangles; it stops below the number.
  const Simplification::Count_stop_predicate<Surface> stop(3 * faces / 2 + 1);
  Simplification::edge_collapse(surface, stop,
                                CGAL::parameters::get_cost(policies.get_cost())
                                    .filter(filter)
                                    .get_placement(policies.get_placement()));
  return ToMesh(std::move(surface));
}

}  // namespace

Outcome<Mesh> Simplify(const Mesh& mesh, std::size_t faces, const Execution& execution) {
  if (faces >= mesh.triangles.size()) return mesh;
  Mesh simple = mesh;
  if (const std::optional<Surface> surface = ToSurface(mesh)) {
    for (double target = static_cast<double>(faces);
         target < static_cast<double>(mesh.triangles.size()) && !execution.IsCancelled();
         target *= kMore) {
      Mesh candidate = Collapse(*surface, static_cast<std::size_t>(target));
      if (!CheckMesh(candidate, execution).IsPrintable()) continue;
      simple = std::move(candidate);
      break;
    }
  }
  if (execution.IsCancelled()) {
    return Outcome<Mesh>::Failure(
        Error(FailureKind::kInterrupted, "cancelled", "the run was stopped"));
  }
  Diagnostics log;
  if (simple.triangles.size() > faces) {
    log.push_back(Note("more-faces",
                       fmt::format("{} faces are asked for; {} are the fewest that were found to "
                                   "stay one closed solid that does not run through itself",
                                   faces, simple.triangles.size())));
  }
  return {std::move(simple), std::move(log)};
}

}  // namespace lascaux

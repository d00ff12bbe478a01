// CGAL's implicit mesher on a body's field, as JSON: milliseconds of one run, since it takes
// seconds.
//
//     bench_cgal bench/data/animal.txt RESOLUTION
//
// Triangles are as large as those of a grid with so many voxels along the longest side.

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>

#include "body.h"
#include "lascaux/field/compiled_field.h"

namespace {

using namespace lascaux;
using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Traits = Triangulation::Geom_traits;
using Surface = CGAL::Implicit_surface_3<Traits, std::function<double(Traits::Point_3)>>;

/// Below 0 inside. One point at a time is all that the mesher asks for.
double Below(const CompiledField& field, const ActiveSet& all, const Traits::Point_3& p) {
  const float zero = 0;
  float value = 0;
  field.EvaluateValues({{p.x(), p.y(), p.z()}, {&zero, 1}, {&zero, 1}, {&zero, 1}}, all,
                       {&value, 1});
  return kIsoValue - static_cast<double>(value);
}

}  // namespace

int main(int argc, char** argv) {
  const Field field = argc == 3 ? ReadBody(argv[1], BodyBlend::kPlainSum) : Field{};
  const int resolution = argc == 3 ? std::atoi(argv[2]) : 0;
  if (field.parts.empty() || resolution <= 0) {
    std::cerr << "usage: bench_cgal BODY RESOLUTION\n";
    return 2;
  }
  const CompiledField compiled(field);
  const ActiveSet all = compiled.All();
  const Eigen::Vector3d size = Bounds(field).sizes();
  const double voxel = size.maxCoeff() / resolution;
  const Segment& first = field.parts[0].chains[0].segments[0];
  const Eigen::Vector3d inside = (first.a + first.b) / 2;

  const auto start = std::chrono::steady_clock::now();
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> mesh(triangulation);
  const Traits::Point_3 center(inside.x(), inside.y(), inside.z());
  const Surface surface([&](const Traits::Point_3& p) { return Below(compiled, all, p); },
                        Traits::Sphere_3(center, 4 * size.squaredNorm()), 1e-6);
  constexpr double kLeastAngle = 30;  // degrees: the most that is sure to end
  // Of the circle around a triangle: that of half of a voxel's face.
  const double radius = voxel / std::sqrt(2.0);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(kLeastAngle, radius, voxel);
  CGAL::make_surface_mesh(mesh, surface, criteria, CGAL::Non_manifold_tag());
  const double ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  std::cout << "{\"vertices\": " << triangulation.number_of_vertices() << ", \"ms\": " << ms
            << "}\n";
}

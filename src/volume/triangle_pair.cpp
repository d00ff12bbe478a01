#include "volume/triangle_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "volume/exact_predicates.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

// Products of up to four vectors are rounded by less than 40 units in the last place (2^-53 each)
// of the product of their lengths; this is a hundred times that.
constexpr double kRounding = 5e-13;

double Largest(std::span<const Vector3d> vectors) {
  double largest = 0;
  for (const Vector3d& v : vectors) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return largest;
}

Corners At(const Mesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Is there certainly a plane with normal `axis` between the two triangles? `scale` bounds
/// |axis| times the corners' coordinates.
bool Separates(const Vector3d& axis, std::span<const Vector3d, 6> p, double scale) {
  std::array<double, 6> at;
  for (std::size_t i = 0; i < 6; ++i) at[i] = axis.dot(p[i]);
  const double low_a = std::min({at[0], at[1], at[2]}), high_a = std::max({at[0], at[1], at[2]});
  const double low_b = std::min({at[3], at[4], at[5]}), high_b = std::max({at[3], at[4], at[5]});
  return std::max(low_a - high_b, low_b - high_a) > kRounding * scale;
}

bool ApartTrianglesIntersect(const Mesh& mesh, const Triangle& a, const Triangle& b) {
  std::array<Vector3d, 6> p;
  const Vector3d origin = mesh.vertices[a[0]].cast<double>();
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = mesh.vertices[a[k]].cast<double>() - origin;
    p[3 + k] = mesh.vertices[b[k]].cast<double>() - origin;
  }
  const double l = Largest(p);
  if (Separates(p[3] + p[4] + p[5] - p[0] - p[1] - p[2], p, 6 * l * l)) return false;
  const Vector3d normal_a = p[1].cross(p[2]);
  if (Separates(normal_a, p, l * l * l)) return false;
  const Vector3d normal_b = (p[4] - p[3]).cross(p[5] - p[3]);
  if (Separates(normal_b, p, 4 * l * l * l)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = k == 2 ? 0 : k + 1;
    if (Separates(normal_a.cross(p[next] - p[k]), p, 2 * l * l * l * l)) return false;
    if (Separates(normal_b.cross(p[3 + next] - p[3 + k]), p, 8 * l * l * l * l)) return false;
  }
  return TrianglesMeet(At(mesh, a), At(mesh, b));
}

/// Are c and d certainly both on the negative side of the plane through the origin with this
/// normal?
bool BothBelow(const Vector3d& normal, const Vector3d& c, const Vector3d& d, double scale) {
  return std::max(normal.dot(c), normal.dot(d)) < -kRounding * scale;
}

/// The planes that bound the sector (a, b) with corner at the origin: are c and d certainly beyond
/// one of them?
bool SectorExcludes(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
                    double l) {
  const Vector3d normal = a.cross(b);
  return BothBelow(normal, c, d, l * l * l) || BothBelow(-normal, c, d, l * l * l) ||
         BothBelow(normal.cross(a), c, d, l * l * l * l) ||
         BothBelow(b.cross(normal), c, d, l * l * l * l);
}

/// a[0] == b[0] is the one common corner.
bool CornerNeighboursIntersect(const Mesh& mesh, const Triangle& a, const Triangle& b) {
  const Vector3d origin = mesh.vertices[a[0]].cast<double>();
  const auto relative = [&](std::uint32_t v) -> Vector3d {
    return mesh.vertices[v].cast<double>() - origin;
  };
  const std::array<Vector3d, 4> p = {relative(a[1]), relative(a[2]), relative(b[1]),
                                     relative(b[2])};
  const double l = Largest(p);
  if (SectorExcludes(p[0], p[1], p[2], p[3], l) || SectorExcludes(p[2], p[3], p[0], p[1], l)) {
    return false;
  }
  // What they share besides the corner is convex and contains it, so it reaches an opposite side.
  const Corners corners_a = At(mesh, a), corners_b = At(mesh, b);
  return SegmentMeetsTriangle(corners_a[1], corners_a[2], corners_b) ||
         SegmentMeetsTriangle(corners_b[1], corners_b[2], corners_a);
}

/// a[0] == b[0] and a[1] == b[1], up to orientation, are the ends of the common edge.
bool EdgeNeighboursIntersect(const Mesh& mesh, const Triangle& a, const Triangle& b) {
  const Vector3d origin = mesh.vertices[a[0]].cast<double>();
  const auto relative = [&](std::uint32_t v) -> Vector3d {
    return mesh.vertices[v].cast<double>() - origin;
  };
  const std::array<Vector3d, 3> p = {relative(a[1]), relative(a[2]), relative(b[2])};
  const double l = Largest(p);
  const Vector3d normal = p[0].cross(p[1]);
  const Vector3d inward = normal.cross(p[0]);
  if (inward.dot(p[2]) < -kRounding * l * l * l * l) return false;
  if (std::abs(normal.dot(p[2])) > kRounding * l * l * l) return false;
  return OverlapAcrossEdge(mesh.vertices[a[0]], mesh.vertices[a[1]], mesh.vertices[a[2]],
                           mesh.vertices[b[2]]);
}

}  // namespace

bool PairIntersects(const Mesh& mesh, const Triangle& a, const Triangle& b) {
  // Common corners to the front of both, in the same order.
  Triangle x = a, y = b;
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = std::find(y.begin() + static_cast<std::ptrdiff_t>(shared), y.end(), a[i]);
    if (at == y.end()) continue;
    std::swap(*at, y[shared]);
    std::swap(*std::find(x.begin() + static_cast<std::ptrdiff_t>(shared), x.end(), a[i]),
              x[shared]);
    ++shared;
  }
  switch (shared) {
    case 0:
      return ApartTrianglesIntersect(mesh, a, b);
    case 1:
      return CornerNeighboursIntersect(mesh, x, y);
    case 2:
      return EdgeNeighboursIntersect(mesh, x, y);
    default:
      return true;
  }
}

}  // namespace lascaux

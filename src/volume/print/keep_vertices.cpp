#include "lascaux/volume/keep_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lascaux {
namespace {

constexpr double kSame = 0.25;  // of a cell: more than ExtractMesh moves vertices onto a field

struct CellVertex {
  std::array<int, 3> cell;
  std::size_t vertex;

  bool operator<(const CellVertex& other) const { return cell < other.cell; }
};

/// The vertices of a mesh that are alone in their cells, by cells.
std::vector<CellVertex> LoneVertices(const Mesh& mesh, const Lattice& lattice) {
  std::vector<CellVertex> all;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Eigen::Vector3d at = (mesh.vertices[v].cast<double>() - lattice.origin) / lattice.size;
    const Eigen::Vector3i cell = at.array().floor().cast<int>();
    all.push_back({{cell.x(), cell.y(), cell.z()}, v});
  }
  std::sort(all.begin(), all.end());
  std::vector<CellVertex> lone;
  for (auto one = all.begin(); one != all.end();) {
    const auto next = std::upper_bound(one, all.end(), *one);
    if (next - one == 1) lone.push_back(*one);
    one = next;
  }
  return lone;
}

}  // namespace

void KeepVertices(const Mesh& before, const Lattice& lattice, Mesh& mesh) {
  const std::vector<CellVertex> old = LoneVertices(before, lattice);
  const auto near = static_cast<float>(kSame * lattice.size);
  for (const CellVertex& one : LoneVertices(mesh, lattice)) {
    const auto found = std::lower_bound(old.begin(), old.end(), one);
    if (found == old.end() || found->cell != one.cell) continue;
    const Eigen::Vector3f& place = before.vertices[found->vertex];
    if ((place - mesh.vertices[one.vertex]).norm() < near) mesh.vertices[one.vertex] = place;
  }
}

}  // namespace lascaux

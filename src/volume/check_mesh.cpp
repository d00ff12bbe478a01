#include "lascaux/volume/check_mesh.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <vector>

#include "base/union_find.h"
#include "lascaux/base/arena.h"
#include "volume/corner_table.h"
#include "volume/edges.h"
#include "volume/exact_predicates.h"
#include "volume/lattice_proof.h"
#include "volume/mesh_measures.h"
#include "volume/self_intersections.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// What edges and corners say, with the components of the vertices.
struct Topology {
  bool closed = false, manifold = false, consistent = false;
  int components = 0;
  std::optional<int> genus;
  std::vector<std::uint32_t> root;  // of each vertex's component, where there are several
};

/// Of 0 to count - 1, how many are such?
template <typename IsSuch>
std::int64_t CountIf(std::size_t count, IsSuch&& is_such) {
  constexpr std::size_t kGrain = 4096;
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, count, kGrain), std::int64_t{0},
      [&](const Range& range, std::int64_t sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) sum += is_such(i) ? 1 : 0;
        return sum;
      },
      std::plus<>());
}

Topology MeasureTopology(const Mesh& mesh) {
  Topology topology;
  const EdgeTable table(mesh);
  // Corners of one vertex are in one fan when edges between their triangles join them.
  UnionFind fans(3 * mesh.triangles.size());
  std::int64_t edges = 0;
  topology.closed = topology.manifold = topology.consistent = true;
  table.ForEdges([&](std::uint32_t low, std::span<const EdgeSide> sides) {
    ++edges;
    topology.closed = topology.closed && sides.size() % 2 == 0;
    topology.manifold = topology.manifold && sides.size() <= 2;
    std::int64_t balance = 0;
    std::array<std::uint32_t, 2> first{};  // corners at the edge's ends in its first triangle
    for (const EdgeSide& s : sides) {
      const std::uint32_t t = s.Triangle(), k = s.side % 3, next = 3 * t + (k + 1) % 3;
      const bool forward = mesh.triangles[t][k] == low;
      balance += forward ? 1 : -1;
      const std::array<std::uint32_t, 2> ends = {forward ? s.side : next, forward ? next : s.side};
      if (&s == sides.data()) first = ends;
      fans.Join(first[0], ends[0]);
      fans.Join(first[1], ends[1]);
    }
    topology.consistent = topology.consistent && balance == 0;
  });
  topology.closed = topology.closed && edges > 0;
  topology.consistent = topology.consistent && edges > 0;

  std::vector<std::uint32_t> fans_at(mesh.vertices.size(), 0);
  UnionFind pieces(mesh.vertices.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (fans.Root(3 * t + k) == 3 * t + k) ++fans_at[corners[k]];
    }
    pieces.Join(corners[0], corners[1]);
    pieces.Join(corners[0], corners[2]);
  }
  topology.root.resize(mesh.vertices.size());
  std::int64_t used = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    topology.manifold = topology.manifold && fans_at[v] == 1;
    topology.root[v] = pieces.Root(v);
    if (fans_at[v] == 0) continue;
    ++used;
    topology.components += topology.root[v] == v ? 1 : 0;
  }
  topology.manifold = topology.manifold && edges > 0;
  if (topology.closed && topology.manifold && topology.components == 1) {
    const std::int64_t euler = used - edges + static_cast<std::int64_t>(mesh.triangles.size());
    topology.genus = static_cast<int>((2 - euler) / 2);
  }
  return topology;
}

/// The same for a mesh with closed fans only.
Topology TopologyOfClosedFans(const Mesh& mesh) {
  Topology topology;
  topology.closed = topology.manifold = topology.consistent = true;
  const std::size_t vertices = mesh.vertices.size();
  UnionFind pieces(vertices);
  const auto join = [&](std::size_t corner) {
    tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
      pieces.Join(mesh.triangles[t][0], mesh.triangles[t][corner]);
    });
    topology.components = static_cast<int>(CountIf(
        vertices, [&](std::size_t v) { return pieces.IsRoot(static_cast<std::uint32_t>(v)); }));
  };
  // One side of each triangle nearly always connects all of a piece.
  join(1);
  if (topology.components > 1) join(2);
  if (topology.components == 1) {
    const std::int64_t euler =
        static_cast<std::int64_t>(vertices) - static_cast<std::int64_t>(mesh.triangles.size()) / 2;
    topology.genus = static_cast<int>((2 - euler) / 2);
    return topology;
  }
  topology.root.resize(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) topology.root[v] = pieces.Root(v);
  return topology;
}

bool AreComponentsOutward(const Mesh& mesh, const Topology& topology) {
  std::vector<double> volume_at(mesh.vertices.size(), 0);
  const Vector3d middle = MiddleOf(mesh);
  for (const auto& t : mesh.triangles)
    volume_at[topology.root[t[0]]] += SixVolumes(mesh, t, middle);
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const auto& t) { return volume_at[topology.root[t[0]]] > 0; });
}

bool HasArea(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Corners p = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  const Vector3d u = p[1].cast<double>() - p[0].cast<double>();
  const Vector3d v = p[2].cast<double>() - p[0].cast<double>();
  // A thousand times what rounding in double precision can feign.
  if (u.cross(v).norm() > 1e-12 * u.norm() * v.norm()) return true;
  return !AreCollinear(p);
}

std::vector<std::uint32_t> WithArea(const Mesh& mesh, const std::vector<std::uint32_t>& of) {
  std::vector<std::uint8_t> good(of.size());
  tbb::parallel_for(std::size_t{0}, of.size(),
                    [&](std::size_t i) { good[i] = HasArea(mesh, mesh.triangles[of[i]]) ? 1 : 0; });
  std::vector<std::uint32_t> result;
  result.reserve(of.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (good[i] != 0) result.push_back(of[i]);
  }
  return result;
}

std::int64_t CountCoincident(const std::vector<Vector3f>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  const auto key = [&](std::uint32_t i) {
    const Vector3f& v = vertices[i];
    return std::make_tuple(v.x(), v.y(), v.z());
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
  std::int64_t count = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    count += key(order[i - 1]) == key(order[i]) ? 1 : 0;
  }
  return count;
}

std::int64_t CountInvalid(const Mesh& mesh) {
  const auto points_nowhere = [&](std::size_t i) {
    const auto& t = mesh.triangles[i];
    return std::max({t[0], t[1], t[2]}) >= mesh.vertices.size();
  };
  return CountIf(mesh.vertices.size(),
                 [&](std::size_t v) { return !mesh.vertices[v].allFinite(); }) +
         CountIf(mesh.triangles.size(), points_nowhere);
}

}  // namespace

bool MeshFacts::IsPrintable() const noexcept {
  return closed && manifold && oriented && components == 1 && degenerate == 0 && coincident == 0 &&
         invalid == 0 && self_intersections.value_or(0) == 0;
}

namespace {

/// A check, with what is known of the mesh beforehand.
class Check {
 public:
  Check(const Mesh& mesh, const std::optional<Lattice>& lattice, const Execution& execution)
      : mesh_(mesh), lattice_(lattice), execution_(execution) {}

  MeshFacts Run() {
    facts_.vertices = static_cast<std::int64_t>(mesh_.vertices.size());
    facts_.triangles = static_cast<std::int64_t>(mesh_.triangles.size());
    RunInArena(execution_, [this] { Measure(); });
    return facts_;
  }

 private:
  void Measure() {
    facts_.invalid = CountInvalid(mesh_);
    // Nothing can be said of a mesh that points nowhere, and a slicer takes none of it.
    if (facts_.invalid > 0) return;
    std::optional<LatticeProof> proof;
    if (lattice_) proof = ProveByLattice(mesh_, *lattice_);
    const bool fans = !mesh_.triangles.empty() &&
                      (proof ? proof->closed_fans : HasClosedFansOnly(mesh_, CornerTable(mesh_)));
    tbb::parallel_invoke([&] { CheckTopology(fans); },
                         [&] { fans&& proof ? CheckDual(*proof) : CheckPlaces(); });
  }

  void CheckTopology(bool fans) {
    const Topology found = fans ? TopologyOfClosedFans(mesh_) : MeasureTopology(mesh_);
    facts_.closed = found.closed;
    facts_.manifold = found.manifold;
    facts_.components = found.components;
    facts_.genus = found.genus;
    const MeshMeasures measures = MeasureTriangles(mesh_);
    facts_.volume = measures.volume;
    facts_.area = measures.area;
    facts_.oriented =
        found.consistent &&
        (found.components == 1 ? measures.volume > 0 : AreComponentsOutward(mesh_, found));
  }

  void CheckDual(const LatticeProof& proof) {
    facts_.coincident = proof.coincident;
    CountIntersections(proof.doubtful);
  }

  void CheckPlaces() {
    std::vector<std::uint32_t> all(mesh_.triangles.size());
    std::iota(all.begin(), all.end(), std::uint32_t{0});
    tbb::parallel_invoke([&] { facts_.coincident = CountCoincident(mesh_.vertices); },
                         [&] { CountIntersections(all); });
  }

  void CountIntersections(const std::vector<std::uint32_t>& of) {
    const std::vector<std::uint32_t> solid = WithArea(mesh_, of);
    facts_.degenerate = static_cast<std::int64_t>(of.size() - solid.size());
    facts_.self_intersections = CountSelfIntersections(mesh_, solid, execution_);
  }

  const Mesh& mesh_;
  const std::optional<Lattice>& lattice_;
  const Execution& execution_;
  MeshFacts facts_;
};

}  // namespace

MeshFacts CheckMesh(const Mesh& mesh, const Execution& execution) {
  return Check(mesh, std::nullopt, execution).Run();
}

MeshFacts CheckMesh(const Mesh& mesh, const Lattice& lattice, const Execution& execution) {
  return Check(mesh, lattice, execution).Run();
}

Diagnostics MeshDefects(const MeshFacts& facts) {
  Diagnostics defects;
  const auto add = [&](const char* code, std::string message) {
    defects.push_back(Error(FailureKind::kMesh, code, std::move(message)));
  };
  if (facts.triangles == 0) {
    add("mesh-empty", "the mesh has no triangles");
    return defects;
  }
  if (facts.invalid > 0) {
    add("mesh-invalid",
        fmt::format("{} vertices are not finite or triangles point past the last vertex; nothing "
                    "else was measured",
                    facts.invalid));
    return defects;
  }
  if (!facts.closed) add("mesh-open", "the mesh has open edges: a slicer can't tell its inside");
  if (!facts.manifold) {
    add("mesh-not-manifold",
        "an edge has more than two triangles, or a vertex has none or more than one fan of them");
  }
  if (!facts.oriented) {
    add("mesh-not-oriented",
        fmt::format("triangles face different ways or inward (volume {:.6g})", facts.volume));
  }
  if (facts.degenerate > 0) {
    add("mesh-degenerate", fmt::format("{} triangles have no area", facts.degenerate));
  }
  if (facts.coincident > 0) {
    add("mesh-coincident",
        fmt::format("{} vertices are at the same place as another", facts.coincident));
  }
  if (facts.self_intersections.value_or(0) > 0) {
    add("mesh-self-intersects",
        fmt::format("{} pairs of triangles run through each other", *facts.self_intersections));
  }
  if (facts.components > 1) {
    add("mesh-in-pieces", fmt::format("the mesh is in {} pieces", facts.components));
  }
  return defects;
}

}  // namespace lascaux

#include "volume/shells.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/union_find.h"
#include "volume/mesh_measures.h"

namespace lascaux {
namespace {

constexpr std::size_t kSingleWarnings = 10;
/// A piece that is no larger than this, in voxels, is what sampling leaves of a tip or a slit that
/// is thinner than a voxel: not a part that came off.
constexpr float kTrace = 2;
constexpr std::uint32_t kRemoved = std::numeric_limits<std::uint32_t>::max();

struct Shell {
  double volume = 0;
  Eigen::AlignedBox3f box;
};

/// Number of the shell of each vertex, and the shells.
struct Shells {
  std::vector<std::uint32_t> of;
  std::vector<Shell> shells;
};

Shells FindShells(const Mesh& mesh, UnionFind& sets) {
  Shells found;
  found.of.resize(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::uint32_t root = sets.Root(v);  // never above v
    if (root == v) {
      found.of[v] = static_cast<std::uint32_t>(found.shells.size());
      found.shells.emplace_back();
    } else {
      found.of[v] = found.of[root];
    }
    found.shells[found.of[v]].box.extend(mesh.vertices[v]);
  }
  if (found.shells.size() == 1) {
    found.shells.front().volume = VolumeOf(mesh);
    return found;
  }
  for (const auto& t : mesh.triangles) {
    Shell& shell = found.shells[found.of[t[0]]];
    shell.volume += SixVolumes(mesh, t, shell.box.center().cast<double>()) / 6;
  }
  return found;
}

void Keep(Mesh& mesh, const Shells& found, std::uint32_t kept) {
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kRemoved);
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (found.of[v] != kept) continue;
    mesh.vertices[count] = mesh.vertices[v];
    if (!mesh.outward.empty()) mesh.outward[count] = mesh.outward[v];
    renumbered[v] = count++;
  }
  mesh.vertices.resize(count);
  if (!mesh.outward.empty()) mesh.outward.resize(count);
  std::erase_if(mesh.triangles, [&](const auto& t) { return renumbered[t[0]] == kRemoved; });
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = renumbered[v];
  }
}

Diagnostic OfOne(const Shell& shell, float voxel) {
  const Eigen::Vector3f at = shell.box.center(), size = shell.box.sizes();
  const char* what = shell.volume > 0 ? "separate piece" : "cavity";
  if (size.maxCoeff() <= kTrace * voxel) {
    return Note("crumb-removed",
                fmt::format("a {} at ({:.4g}, {:.4g}, {:.4g}), no larger than two voxels, was "
                            "removed; the model is thinner than a voxel ({:.3g}) there",
                            what, at.x(), at.y(), at.z(), voxel));
  }
  return Warning("crumb-removed",
                 fmt::format("a {} at ({:.4g}, {:.4g}, {:.4g}), {:.3g} x {:.3g} x {:.3g} in size, "
                             "is not connected with the body's surface and was removed",
                             what, at.x(), at.y(), at.z(), size.x(), size.y(), size.z()));
}

Diagnostics Warnings(const std::vector<Shell>& shells, std::size_t kept, float voxel) {
  std::vector<Shell> removed;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (s != kept) removed.push_back(shells[s]);
  }
  std::stable_sort(removed.begin(), removed.end(), [](const Shell& a, const Shell& b) {
    return std::abs(a.volume) > std::abs(b.volume);
  });
  Diagnostics warnings;
  for (std::size_t i = 0; i < std::min(removed.size(), kSingleWarnings); ++i) {
    warnings.push_back(OfOne(removed[i], voxel));
  }
  if (removed.size() > kSingleWarnings) {
    warnings.push_back(Warning("crumb-removed",
                               fmt::format("{} more pieces and cavities, all smaller, were removed",
                                           removed.size() - kSingleWarnings)));
  }
  return warnings;
}

}  // namespace

Outcome<Mesh> KeepLargestShell(Mesh mesh, double voxel) {
  UnionFind sets(mesh.vertices.size());
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const auto& t = mesh.triangles[i];
    sets.Join(t[0], t[1]);
    sets.Join(t[0], t[2]);
  });
  const Shells found = FindShells(mesh, sets);
  const auto largest =
      std::max_element(found.shells.begin(), found.shells.end(),
                       [](const Shell& a, const Shell& b) { return a.volume < b.volume; });
  if (largest == found.shells.end() || !(largest->volume > 0)) {
    return Outcome<Mesh>::Failure(
        Error(FailureKind::kUnderstanding, "empty-mesh",
              "the grid has no surface around a body: nothing in it is below 0 and enclosed"));
  }
  const auto kept = static_cast<std::size_t>(largest - found.shells.begin());
  if (found.shells.size() > 1) Keep(mesh, found, static_cast<std::uint32_t>(kept));
  return Outcome<Mesh>(std::move(mesh), Warnings(found.shells, kept, static_cast<float>(voxel)));
}

}  // namespace lascaux

#include "volume/corner_table.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace lascaux {
namespace {

constexpr std::size_t kVerticesATask = 2048;
constexpr std::size_t kMostCorners = 64;  // at a vertex; with more it is left to slower code

/// An edge opposite to the vertex, as its triangle runs through it.
struct Opposite {
  std::uint32_t from, to;
};

}  // namespace

bool IsClosedFan(const Mesh& mesh, std::uint32_t vertex, std::span<const std::uint32_t> corners) {
  const std::size_t count = corners.size();
  if (count < 3 || count > kMostCorners) return false;
  std::array<Opposite, kMostCorners> edges;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& t = mesh.triangles[corners[i] / 3];
    const std::uint32_t k = corners[i] % 3;
    const Opposite edge = {t[k == 2 ? 0 : k + 1], t[k == 0 ? 2 : k - 1]};
    if (edge.from == vertex || edge.to == vertex || edge.from == edge.to) return false;
    edges[i] = edge;
  }
  // From edge to edge: a walk that returns to its first after all others has met each once.
  std::size_t at = 0;
  for (std::size_t step = 1; step <= count; ++step) {
    const std::uint32_t to = edges[at].to;
    at = 0;
    while (at < count && edges[at].from != to) ++at;
    if (at == count || (at == 0) != (step == count)) return false;
  }
  return true;
}

CornerTable::CornerTable(const Mesh& mesh)
    : first_(mesh.vertices.size() + 1, 0), corners_(3 * mesh.triangles.size()) {
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) ++first_[v + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  std::uint32_t corner = 0;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) corners_[next[v]++] = corner++;
  }
}

bool HasClosedFansOnly(const Mesh& mesh, const CornerTable& table) {
  std::atomic<bool> all = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, table.vertices(), kVerticesATask),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t v = range.begin(); v < range.end() && all; ++v) {
                        if (!IsClosedFan(mesh, static_cast<std::uint32_t>(v), table.At(v)))
                          all = false;
                      }
                    });
  return all;
}

}  // namespace lascaux

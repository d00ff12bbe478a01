#include "volume/check/thin_regions.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>
#include <vector>

#include "base/union_find.h"

namespace lascaux {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTipLength = 3;   // in limits: a cone of 19 degrees is that long where it is thin
constexpr std::size_t kRays = 64;  // from each thick piece, to find what is on its other side
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A mesh's vertices, the way to the neighbours, and what is known of each.
class Regions {
 public:
  Regions(const Mesh& mesh, const std::vector<Wall>& walls, double limit)
      : mesh_(mesh), walls_(walls), limit_(limit), is_thin_(mesh.vertices.size(), 0) {
    for (const Wall& wall : walls)
      for (const std::uint32_t v : mesh.triangles[wall.triangle]) is_thin_[v] = 1;
    ListTriangles();
  }

  ThinPlaces Tell(const TriangleGrid& grid) {
    FindThickPieces();
    JoinOppositeSides(grid);
    MeasureFromThick();
    return Sort();
  }

 private:
  void ListTriangles() {
    first_.assign(mesh_.vertices.size() + 1, 0);
    for (const auto& t : mesh_.triangles)
      for (const std::uint32_t v : t) ++first_[v + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    around_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t]) around_[next[v]++] = t;
  }

  /// Lengths of ways along edges from the vertices at which `distance` is 0, up to `farthest`;
  /// `arrive(from, to)` is called when a shorter way is found.
  template <typename Arrive>
  void Spread(std::vector<double>& distance, double farthest, Arrive&& arrive) const {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    // Only from where the way leads on.
    std::vector<std::uint8_t> is_queued(distance.size(), 0);
    for (const auto& t : mesh_.triangles) {
      if (distance[t[0]] == 0 && distance[t[1]] == 0 && distance[t[2]] == 0) continue;
      for (const std::uint32_t v : t)
        if (distance[v] == 0 && std::exchange(is_queued[v], 1) == 0) queue.emplace(0.0, v);
    }
    while (!queue.empty()) {
      const auto [so_far, v] = queue.top();
      queue.pop();
      if (so_far > distance[v]) continue;
      for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
        for (const std::uint32_t w : mesh_.triangles[around_[i]]) {
          const auto edge = static_cast<double>((mesh_.vertices[w] - mesh_.vertices[v]).norm());
          if (so_far + edge > farthest || !(so_far + edge < distance[w])) continue;
          distance[w] = so_far + edge;
          arrive(v, w);
          queue.emplace(distance[w], w);
        }
      }
    }
  }

  /// Numbers the connected pieces of what is farther than the limit from all thin places.
  void FindThickPieces() {
    std::vector<double> from_thin(mesh_.vertices.size(), kInfinity);
    for (std::size_t v = 0; v < from_thin.size(); ++v)
      if (is_thin_[v] != 0) from_thin[v] = 0;
    Spread(from_thin, limit_, [](std::uint32_t, std::uint32_t) {});
    UnionFind thick(mesh_.vertices.size()), near(mesh_.vertices.size());
    const auto is_thick = [&](std::uint32_t v) { return from_thin[v] == kInfinity; };
    for (const auto& t : mesh_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (is_thick(a) && is_thick(b)) thick.Join(a, b);
        if (!is_thick(a) && !is_thick(b)) near.Join(a, b);
      }
    }
    piece_.assign(mesh_.vertices.size(), kNone);
    region_.assign(mesh_.vertices.size(), kNone);
    for (std::uint32_t v = 0; v < piece_.size(); ++v)
      (is_thick(v) ? piece_ : region_)[v] = is_thick(v) ? thick.Root(v) : near.Root(v);
  }

  /// The two sides of a lens with a sharp rim are one piece: what most rays from one of them meet.
  void JoinOppositeSides(const TriangleGrid& grid) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;  // of each piece
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (const std::uint32_t piece = piece_[mesh_.triangles[t][0]]; piece != kNone)
        triangles[piece].push_back(t);
    if (triangles.size() < 2) return;
    UnionFind joined(mesh_.vertices.size());
    for (const auto& [piece, own] : triangles) {
      std::map<std::uint32_t, std::size_t> met;
      const std::size_t step = std::max<std::size_t>(1, own.size() / kRays);
      std::size_t rays = 0;
      for (std::size_t i = 0; i < own.size(); i += step, ++rays)
        if (const std::uint32_t other = PieceBehind(grid, own[i]); other != kNone) ++met[other];
      for (const auto& [other, count] : met)
        if (2 * count > rays) joined.Join(piece, other);
    }
    for (std::uint32_t& piece : piece_)
      if (piece != kNone) piece = joined.Root(piece);
  }

  std::uint32_t PieceBehind(const TriangleGrid& grid, std::uint32_t triangle) const {
    const std::atomic<double> anywhere = kInfinity;
    const Hit hit =
        grid.Shoot(triangle, grid.triangle(triangle).Middle(), -grid.normal(triangle), anywhere);
    return hit.distance < kInfinity ? piece_[mesh_.triangles[hit.triangle][0]] : kNone;
  }

  /// Finds the regions that are walls: too far from what is thick, or between two pieces of it.
  void MeasureFromThick() {
    is_wall_.assign(mesh_.vertices.size(), 0);
    std::vector<double> from_thick(mesh_.vertices.size(), kInfinity);
    for (std::size_t v = 0; v < from_thick.size(); ++v)
      if (piece_[v] != kNone) from_thick[v] = 0;
    std::vector<std::uint32_t> nearest = piece_;
    // What is thick begins a limit away from what is thin.
    Spread(from_thick, (kTipLength + 1) * limit_,
           [&](std::uint32_t from, std::uint32_t to) { nearest[to] = nearest[from]; });
    for (std::size_t v = 0; v < from_thick.size(); ++v)
      if (is_thin_[v] != 0 && from_thick[v] == kInfinity) is_wall_[region_[v]] = 1;
    for (const auto& t : mesh_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (region_[a] == kNone || region_[b] == kNone) continue;
        if (nearest[a] == kNone || nearest[b] == kNone) continue;
        if (nearest[a] != nearest[b]) is_wall_[region_[a]] = 1;
      }
    }
  }

  ThinPlaces Sort() const {
    ThinPlaces places;
    for (const Wall& wall : walls_) {
      const bool is_wall = is_wall_[region_[mesh_.triangles[wall.triangle][0]]] != 0;
      std::optional<Wall>& thinnest = is_wall ? places.wall : places.tip;
      if (!thinnest || wall.thickness < thinnest->thickness) thinnest = wall;
    }
    return places;
  }

  const Mesh& mesh_;
  const std::vector<Wall>& walls_;
  double limit_;
  std::vector<std::uint8_t> is_thin_, is_wall_;  // the latter by regions
  std::vector<std::uint32_t> first_, around_;    // triangles of each vertex
  std::vector<std::uint32_t> piece_, region_;    // of each vertex, one of the two kNone
};

}  // namespace

ThinPlaces TellThinPlaces(const Mesh& mesh, const std::vector<Wall>& walls, double limit,
                          const TriangleGrid& grid) {
  if (walls.empty()) return {};
  return Regions(mesh, walls, limit).Tell(grid);
}

ThinPlaces TellThinPlaces(const Mesh& mesh, const std::vector<Wall>& walls, double limit) {
  if (walls.empty()) return {};
  return TellThinPlaces(mesh, walls, limit, TriangleGrid(mesh));
}

}  // namespace lascaux

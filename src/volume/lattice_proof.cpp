#include "volume/lattice_proof.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "volume/envelope.h"

namespace lascaux {
namespace {

using Eigen::Array3i;
using Eigen::Vector3d;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kGrain = 2048;  // vertices or quadrilaterals a task
// In units of the lattice. Places in cells are rounded by less than a thousandth of it, as far out
// as kFarthestCell.
constexpr double kMargin = 1e-8;
constexpr double kFarthestCell = 1e6;
constexpr int kCellBits = 21;

/// A cell as a number; not 0 within kFarthestCell.
std::uint64_t Key(const Array3i& cell) {
  constexpr int kShift = 1 << (kCellBits - 1);
  std::uint64_t key = 0;
  for (int axis = 2; axis >= 0; --axis) {
    key = key << kCellBits | static_cast<std::uint64_t>(cell[axis] + kShift);
  }
  return key;
}

std::size_t Hash(std::uint64_t key, int bits) {
  return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15u >> (64 - bits));  // Fibonacci hashing
}

/// A place in its cell: 0 to 1 along each axis.
struct Placed {
  Array3i cell;
  Vector3d at;
};

/// Where each vertex is, and which cells have one vertex.
class Cells {
 public:
  Cells(const Mesh& mesh, const Lattice& lattice)
      : mesh_(mesh),
        lattice_(lattice),
        bits_(std::max(4, static_cast<int>(std::bit_width(2 * mesh.vertices.size())))),
        keys_(std::size_t{1} << bits_),
        slot_(mesh.vertices.size(), kNoSlot),
        placed_(mesh.vertices.size()) {
    tbb::parallel_for(Range(0, slot_.size(), kGrain), [this](const Range& range) {
      for (std::size_t v = range.begin(); v < range.end(); ++v) {
        const auto placed = Place(v);
        if (!placed) continue;
        placed_[v] = *placed;
        slot_[v] = Insert(Key(placed->cell));
      }
    });
  }

  Vector3d InCells(std::size_t vertex) const {
    return (mesh_.vertices[vertex].cast<double>() - lattice_.origin) / lattice_.size;
  }

  /// Where it is, if it is alone in its cell.
  const Placed& At(std::size_t vertex) const { return placed_[vertex]; }

  /// Alone in its cell.
  bool IsAlone(std::size_t vertex) const {
    return slot_[vertex] != kNoSlot &&
           (keys_[slot_[vertex]].load(std::memory_order_relaxed) & kShared) == 0;
  }

 private:
  static constexpr std::uint32_t kNoSlot = ~0u;
  static constexpr std::uint64_t kEmpty = 0;
  static constexpr std::uint64_t kShared = std::uint64_t{1} << (3 * kCellBits);

  /// Empty when it is on the border of cells, or too far out for that to be known.
  std::optional<Placed> Place(std::size_t vertex) const {
    const Vector3d in_cells = InCells(vertex);
    if (!(in_cells.cwiseAbs().maxCoeff() < kFarthestCell)) return std::nullopt;
    const Vector3d low = in_cells.array().floor();
    const Vector3d at = in_cells - low;
    if (!(at.minCoeff() > kMargin) || !(at.maxCoeff() < 1 - kMargin)) return std::nullopt;
    return Placed{low.array().cast<int>(), at};
  }

  /// Which slot a cell gets depends on who is first, whether it is shared does not.
  std::uint32_t Insert(std::uint64_t key) {
    const std::size_t mask = keys_.size() - 1;
    for (std::size_t i = Hash(key, bits_);; i = (i + 1) & mask) {
      std::uint64_t found = kEmpty;
      if (keys_[i].compare_exchange_strong(found, key)) return static_cast<std::uint32_t>(i);
      if ((found & ~kShared) != key) continue;
      keys_[i].fetch_or(kShared);
      return static_cast<std::uint32_t>(i);
    }
  }

  const Mesh& mesh_;
  const Lattice& lattice_;
  int bits_;
  std::vector<std::atomic<std::uint64_t>> keys_;
  std::vector<std::uint32_t> slot_;
  std::vector<Placed> placed_;
};

/// A quadrilateral as two triangles: (d0, d1, a) and (d1, d0, b).
struct Halves {
  std::uint32_t d0, d1, a, b;
};

std::optional<Halves> JoinHalves(const std::array<std::uint32_t, 3>& s,
                                 const std::array<std::uint32_t, 3>& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t d0 = s[i], d1 = s[(i + 1) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] == d1 && t[(k + 1) % 3] == d0) return Halves{d0, d1, s[(i + 2) % 3], t[(k + 2) % 3]};
    }
  }
  return std::nullopt;
}

/// Corners d0, d1, a, b seen along the edge that their cells are around, if they are: d0 and d1 in
/// opposite ones.
std::optional<std::array<SeenCorner, 4>> SeenAlongEdge(const std::array<Placed, 4>& corners) {
  const Array3i across = corners[1].cell - corners[0].cell;
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    if (across[i] == 0) {
      if (axis >= 0) return std::nullopt;
      axis = i;
    } else if (std::abs(across[i]) != 1) {
      return std::nullopt;
    }
  }
  if (axis < 0) return std::nullopt;
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  const Array3i low = corners[0].cell.min(corners[1].cell);
  std::array<SeenCorner, 4> seen;
  std::array<int, 4> quadrant{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Array3i beyond = corners[i].cell - low;
    if (beyond[axis] != 0 || (beyond[u] & ~1) != 0 || (beyond[w] & ~1) != 0) return std::nullopt;
    quadrant[i] = 2 * beyond[u] + beyond[w];
    // The edge is where the lower cell ends.
    seen[i] = {corners[i].at[u] + beyond[u] - 1, corners[i].at[w] + beyond[w] - 1,
               corners[i].at[axis]};
  }
  if (quadrant[2] == quadrant[3] || quadrant[2] == quadrant[0] || quadrant[2] == quadrant[1] ||
      quadrant[3] == quadrant[0] || quadrant[3] == quadrant[1])
    return std::nullopt;
  return seen;
}

class Proof {
 public:
  Proof(const Mesh& mesh, const CornerTable& table, const Lattice& lattice)
      : mesh_(mesh), table_(table), cells_(mesh, lattice) {}

  LatticeProof Run() {
    const std::size_t triangles = mesh_.triangles.size();
    proven_.assign(triangles, 0);
    tbb::parallel_for(Range(0, triangles / 2, kGrain), [this](const Range& range) {
      for (std::size_t q = range.begin(); q < range.end(); ++q) {
        if (IsProven(q)) proven_[2 * q] = proven_[2 * q + 1] = 1;
      }
    });
    LatticeProof proof;
    proof.coincident = CountCoincident();
    if (std::all_of(proven_.begin(), proven_.end(), [](std::uint8_t p) { return p != 0; }))
      return proof;
    MarkNeighbourhoods();
    for (std::uint32_t t = 0; t < triangles; ++t) {
      if (proven_[t] == 0 || IsNear(mesh_.triangles[t])) proof.doubtful.push_back(t);
    }
    return proof;
  }

 private:
  bool IsProven(std::size_t quad) const {
    const auto halves = JoinHalves(mesh_.triangles[2 * quad], mesh_.triangles[2 * quad + 1]);
    if (!halves) return false;
    const std::array<std::uint32_t, 4> corners = {halves->d0, halves->d1, halves->a, halves->b};
    std::array<Placed, 4> placed;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!cells_.IsAlone(corners[i])) return false;
      placed[i] = cells_.At(corners[i]);
    }
    // Only where two quadrilaterals around one edge close on each other has a diagonal's end three
    // triangles: each has two of its own quadrilateral, and one of the other.
    if (table_.At(halves->d0).size() < 4 || table_.At(halves->d1).size() < 4) return false;
    const auto seen = SeenAlongEdge(placed);
    return seen && IsInEnvelope(*seen, kMargin);
  }

  /// Vertices that coincide are in one cell, or in none.
  std::int64_t CountCoincident() const {
    std::map<std::array<float, 3>, int> seen;
    std::int64_t count = 0;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (cells_.IsAlone(v)) continue;
      const Eigen::Vector3f& p = mesh_.vertices[v];
      count += seen[{p.x(), p.y(), p.z()}]++ > 0 ? 1 : 0;
    }
    return count;
  }

  /// A proven triangle reaches from its cells into the next at most. So one that meets the box of
  /// an unproven triangle has its corners in the cells that this box touches or beside them.
  void MarkNeighbourhoods() {
    near_.assign(std::size_t{1} << (kNearBits - 6), 0);
    for (std::size_t t = 0; t < proven_.size(); ++t) {
      if (proven_[t] != 0) continue;
      Eigen::AlignedBox3d box;
      for (const std::uint32_t v : mesh_.triangles[t]) box.extend(cells_.InCells(v));
      all_near_ = !(box.sizes().maxCoeff() < kMostCells) ||
                  !(box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() < kFarthestCell);
      if (all_near_) return;
      const Array3i low = box.min().array().floor().cast<int>() - 1;
      const Array3i high = box.max().array().floor().cast<int>() + 1;
      for (int x = low.x(); x <= high.x(); ++x) {
        for (int y = low.y(); y <= high.y(); ++y) {
          for (int z = low.z(); z <= high.z(); ++z) {
            const std::size_t bit = Hash(Key({x, y, z}), kNearBits);
            near_[bit / 64] |= std::uint64_t{1} << bit % 64;
          }
        }
      }
    }
  }

  bool IsNear(const std::array<std::uint32_t, 3>& triangle) const {
    if (all_near_) return true;
    return std::any_of(triangle.begin(), triangle.end(), [this](std::uint32_t v) {
      const std::size_t bit = Hash(Key(cells_.At(v).cell), kNearBits);
      return (near_[bit / 64] >> bit % 64 & 1) != 0;
    });
  }

  static constexpr int kNearBits = 20;    // cells that share a bit only cost time
  static constexpr int kMostCells = 256;  // along a doubtful triangle's box

  const Mesh& mesh_;
  const CornerTable& table_;
  Cells cells_;
  std::vector<std::uint8_t> proven_;
  std::vector<std::uint64_t> near_;
  bool all_near_ = false;
};

}  // namespace

LatticeProof ProveByLattice(const Mesh& mesh, const CornerTable& table, const Lattice& lattice) {
  return Proof(mesh, table, lattice).Run();
}

}  // namespace lascaux

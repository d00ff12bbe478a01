#include "volume/lattice_proof.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <map>
#include <utility>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "lascaux/base/unset_allocator.h"
#include "volume/corner_table.h"
#include "volume/lattice_quads.h"
#include "volume/surface_cells.h"

namespace lascaux {
namespace {

using Eigen::Array3i;

constexpr std::size_t kGrain = 2048;  // vertices or quadrilaterals a task

constexpr std::uint32_t kEdges = (1 << kCellEdges) - 1;

// What is known of a vertex.
constexpr std::uint8_t kShared = 1;  // its cell has another vertex
constexpr std::uint8_t kLoose = 2;   // one of its triangles is in no edge's quadrilateral
constexpr std::uint8_t kNear = 4;    // in a cell beside a doubtful triangle

/// Edges of a vertex's cell that quadrilaterals are around, as bits, and those that start inside.
struct EdgesAround {
  std::uint32_t crossed, starts_inside;
};

/// Which edges quadrilaterals at each vertex are around. Each edge of a cell has a byte of its own,
/// so that threads can note edges at one vertex at once without waiting for each other.
class NotedEdges {
 public:
  /// Unset.
  explicit NotedEdges(std::size_t vertices) : bytes_(kCellEdges * vertices + kBehind) {}

  /// Before anything is noted of vertices from `begin` to before `end`.
  void Clear(std::size_t begin, std::size_t end) {
    std::fill(bytes_.begin() + static_cast<std::ptrdiff_t>(kCellEdges * begin),
              bytes_.begin() + static_cast<std::ptrdiff_t>(kCellEdges * end), std::uint8_t{0});
  }

  void Note(std::size_t vertex, std::size_t edge, bool starts_inside) {
    std::atomic_ref(bytes_[kCellEdges * vertex + edge])
        .store(starts_inside ? kInside : kOutside, std::memory_order_relaxed);
  }

  EdgesAround Of(std::size_t vertex) const {
    const std::uint8_t* const bytes = bytes_.data() + kCellEdges * vertex;
#if defined(__SSE2__)
    const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
    const auto bits = [](const __m128i& mask) {
      return static_cast<std::uint32_t>(_mm_movemask_epi8(mask)) & kEdges;
    };
    return {bits(_mm_cmpgt_epi8(all, _mm_setzero_si128())),
            bits(_mm_cmpeq_epi8(all, _mm_set1_epi8(kInside)))};
#else
    EdgesAround edges{0, 0};
    for (std::size_t e = 0; e < kCellEdges; ++e) {
      edges.crossed |= static_cast<std::uint32_t>(bytes[e] != 0) << e;
      edges.starts_inside |= static_cast<std::uint32_t>(bytes[e] == kInside) << e;
    }
    return edges;
#endif
  }

 private:
  static constexpr std::uint8_t kOutside = 1, kInside = 2;
  static constexpr std::size_t kBehind = 4;  // for vectors of 16 bytes
  std::vector<std::uint8_t, UnsetAllocator<std::uint8_t>> bytes_;
};

/// Which sets of a cell's edges one piece of surface can cross, and which of them start inside.
class Rounds {
 public:
  Rounds() {
    starts_.fill(kNone);
    for (std::size_t signs = 0; signs < 256; ++signs) {
      const CellPieces& pieces = PiecesJoined(static_cast<CellSigns>(signs));
      // A face that is crossed twice is no place for one round.
      if (pieces.count != 1 || pieces.twice != kNoFace) continue;
      std::uint32_t crossed = 0, starts = 0;
      for (int e = 0; e < static_cast<int>(kCellEdges); ++e) {
        if (pieces.of_edge[static_cast<std::size_t>(e)] == kNotCrossed) continue;
        const int axis = e / 4, u = e & 1, w = e >> 1 & 1;
        crossed |= 1U << e;
        starts |=
            static_cast<std::uint32_t>(signs >> (u << (axis + 1) % 3 | w << (axis + 2) % 3) & 1)
            << e;
      }
      starts_[crossed] = static_cast<std::uint16_t>(starts);
    }
  }

  bool Has(const EdgesAround& edges) const {
    const std::uint16_t one = starts_[edges.crossed];  // the other has all signs reversed
    return one != kNone &&
           (edges.starts_inside == one || edges.starts_inside == (one ^ edges.crossed));
  }

 private:
  static constexpr std::uint16_t kNone = 0xFFFF;
  std::array<std::uint16_t, kEdges + 1> starts_;
};

/// What tasks find, in their order.
template <typename T>
class Found {
 public:
  explicit Found(std::size_t tasks) : of_task_(tasks) {}
  std::vector<T>& Of(std::size_t task) { return of_task_[task]; }
  std::vector<T> All() const {
    std::vector<T> all;
    for (const std::vector<T>& some : of_task_) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

 private:
  std::vector<std::vector<T>> of_task_;
};

std::size_t Tasks(std::size_t count) { return (count + kGrain - 1) / kGrain; }

/// Calls work(task, begin, end) for ranges of 0 .. count - 1.
template <typename Work>
void ForRanges(std::size_t count, Work&& work) {
  tbb::parallel_for(std::size_t{0}, Tasks(count), [&](std::size_t task) {
    work(task, task * kGrain, std::min(count, (task + 1) * kGrain));
  });
}

/// A set of cells or blocks; what shares a bit with another only costs time.
class Marks {
 public:
  /// For about so many.
  explicit Marks(std::size_t count)
      : shift_(64 - std::clamp(static_cast<int>(std::bit_width(kBitsAMark * count)), kLeastBits,
                               kMostBits)),
        bits_(std::size_t{1} << (64 - shift_ - 6), 0) {}
  void Set(std::uint64_t key) { bits_[Bit(key) / 64] |= std::uint64_t{1} << Bit(key) % 64; }
  bool Has(std::uint64_t key) const { return (bits_[Bit(key) / 64] >> Bit(key) % 64 & 1) != 0; }

 private:
  static constexpr int kLeastBits = 12, kMostBits = 28;
  static constexpr std::size_t kBitsAMark = 32;
  std::size_t Bit(std::uint64_t key) const {
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15u >> shift_);  // Fibonacci hashing
  }
  int shift_;
  std::vector<std::uint64_t> bits_;
};

/// Vertices one after the other in one block.
struct RunOfVertices {
  std::uint64_t block;
  std::size_t first;
};

/// A corner of a triangle, at its vertex.
struct CornerAt {
  std::uint32_t vertex, corner;
  auto operator<=>(const CornerAt&) const = default;
};

class Proof {
 public:
  Proof(const Mesh& mesh, const Lattice& lattice)
      : mesh_(mesh),
        cells_(lattice),
        quads_(mesh.triangles.size() / 2),
        state_(mesh.vertices.size()),
        edges_(mesh.vertices.size()) {}

  std::optional<LatticeProof> Run() {
    if (!FindRuns()) return std::nullopt;
    ForRanges(state_.size(), [this](std::size_t, std::size_t begin, std::size_t end) {
      edges_.Clear(begin, end);
    });
    const std::vector<std::uint32_t> unproven = LookAtQuads();
    LatticeProof proof;
    const Following following = FollowEdges();
    if (following.edges != noted_) return std::nullopt;  // two quadrilaterals are around one edge
    if (!following.are_rounds) return proof;
    if (!MarkNear(unproven)) return std::nullopt;
    proof.closed_fans = Collect(proof.doubtful);
    proof.coincident = CountCoincident();
    return proof;
  }

 private:
  /// Cuts the vertices into runs and marks those that share cells. False where cells don't ascend
  /// in a run, or a block has two.
  bool FindRuns() {
    const std::size_t count = mesh_.vertices.size();
    Found<RunOfVertices> found(Tasks(count));
    std::atomic<bool> is_in_order = true;
    ForRanges(count, [&](std::size_t task, std::size_t begin, std::size_t end) {
      std::uint64_t last = begin == 0 ? ~std::uint64_t{0} : cells_.KeyOf(mesh_.vertices[begin - 1]);
      for (std::size_t v = begin; v < end; ++v) {
        const std::uint64_t key = cells_.KeyOf(mesh_.vertices[v]);
        if (key == last && key != kNoCell) {
          Mark(v - 1, kShared);
          Mark(v, kShared);
        } else if (key >> kBitsInBlock != last >> kBitsInBlock) {
          found.Of(task).push_back({key >> kBitsInBlock, v});
        } else if (key < last || key == kNoCell) {
          is_in_order = false;
        }
        last = key;
      }
    });
    runs_ = found.All();
    std::vector<std::uint64_t> blocks;
    blocks.reserve(runs_.size());
    for (const RunOfVertices& run : runs_) blocks.push_back(run.block);
    std::sort(blocks.begin(), blocks.end());
    return is_in_order && std::adjacent_find(blocks.begin(), blocks.end()) == blocks.end() &&
           (blocks.empty() || blocks.back() != kNoCell >> kBitsInBlock);
  }

  /// Notes at each vertex the edges that quadrilaterals around it are of. Returns those that are
  /// of none, or not in their edges' envelopes.
  std::vector<std::uint32_t> LookAtQuads() {
    Found<std::uint32_t> unproven(Tasks(quads_));
    ForRanges(quads_, [&](std::size_t task, std::size_t begin, std::size_t end) {
      LatticeQuads batch(mesh_, cells_);
      std::size_t noted = 0;
      for (std::size_t at = begin; at < end; at += LatticeQuads::kMost) {
        const std::size_t count = std::min(end - at, LatticeQuads::kMost);
        batch.Look(at, count);
        for (std::size_t i = 0; i < count; ++i) {
          if (NoteEdge(batch, i)) {
            noted += 4;
            if (batch.IsInEnvelope(i)) continue;
          } else {
            Loosen(2 * (at + i));
            Loosen(2 * (at + i) + 1);
          }
          unproven.Of(task).push_back(static_cast<std::uint32_t>(at + i));
        }
      }
      noted_ += noted;
    });
    if (mesh_.triangles.size() % 2 == 1) Loosen(mesh_.triangles.size() - 1);
    return unproven.All();
  }

  bool NoteEdge(const LatticeQuads& batch, std::size_t i) {
    if (!batch.IsAroundEdge(i)) return false;
    for (std::size_t k = 0; k < 4; ++k)
      if ((StateOf(batch.Vertex(i, k)) & kShared) != 0) return false;
    for (std::size_t k = 0; k < 4; ++k)
      edges_.Note(batch.Vertex(i, k), batch.EdgeOf(i, k), batch.StartsInside(i));
    return true;
  }

  void Loosen(std::size_t triangle) {
    for (const std::uint32_t v : mesh_.triangles[triangle]) Mark(v, kLoose);
  }

  /// Edges that were noted, and whether those of each vertex whose triangles all have one make a
  /// round.
  struct Following {
    std::size_t edges = 0;
    bool are_rounds = true;
  };

  /// Lists the vertices whose triangles don't all have an edge.
  Following FollowEdges() {
    static const Rounds rounds;
    Found<std::uint32_t> by_hand(Tasks(state_.size()));
    std::atomic<bool> all = true;
    std::atomic<std::size_t> edges = 0;
    ForRanges(state_.size(), [&](std::size_t task, std::size_t begin, std::size_t end) {
      std::size_t count = 0;
      for (std::size_t v = begin; v < end; ++v) {
        const EdgesAround around = edges_.Of(v);
        count += CountBits(around.crossed);
        if ((StateOf(v) & (kShared | kLoose)) != 0) {
          by_hand.Of(task).push_back(static_cast<std::uint32_t>(v));
        } else if (!rounds.Has(around)) {
          all = false;
        }
      }
      edges += count;
    });
    by_hand_ = by_hand.All();
    return {edges, all};
  }

  /// A proven triangle reaches from its cells into the next at most. So one that meets the box of
  /// an unproven triangle has its corners in the cells that this box touches or beside them. False
  /// where such a box is too large for that to help.
  bool MarkNear(const std::vector<std::uint32_t>& unproven) {
    Marks cells(2 * unproven.size() * kCellsATriangle), blocks(2 * unproven.size());
    const auto mark_around = [&](std::size_t triangle) {
      Eigen::AlignedBox3i box;
      for (const std::uint32_t v : mesh_.triangles[triangle])
        box.extend(cells_.CellOf(mesh_.vertices[v]).matrix());
      if (box.sizes().maxCoeff() > kMostCells) return false;
      for (int x = box.min().x() - 1; x <= box.max().x() + 1; ++x) {
        for (int y = box.min().y() - 1; y <= box.max().y() + 1; ++y) {
          for (int z = box.min().z() - 1; z <= box.max().z() + 1; ++z) {
            const std::uint64_t key = LatticeCells::Key(x, y, z);
            cells.Set(key);
            blocks.Set(key >> kBitsInBlock);
          }
        }
      }
      return true;
    };
    for (const std::uint32_t q : unproven)
      if (!mark_around(2 * std::size_t{q}) || !mark_around(2 * std::size_t{q} + 1)) return false;
    if (mesh_.triangles.size() % 2 == 1 && !mark_around(mesh_.triangles.size() - 1)) return false;
    tbb::parallel_for(std::size_t{0}, runs_.size(), [&](std::size_t r) {
      if (!blocks.Has(runs_[r].block)) return;
      const std::size_t end = r + 1 < runs_.size() ? runs_[r + 1].first : state_.size();
      for (std::size_t v = runs_[r].first; v < end; ++v)
        if (cells.Has(cells_.KeyOf(mesh_.vertices[v]))) Mark(v, kNear);
    });
    return true;
  }

  /// Lists the triangles near unproven ones, which are among them. Are the fans closed that edges
  /// don't tell of?
  bool Collect(std::vector<std::uint32_t>& doubtful) {
    const std::size_t count = mesh_.triangles.size();
    Found<std::uint32_t> near(Tasks(count));
    Found<CornerAt> corners(Tasks(count));
    ForRanges(count, [&](std::size_t task, std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto& v = mesh_.triangles[t];
        const int any = StateOf(v[0]) | StateOf(v[1]) | StateOf(v[2]);
        if ((any & (kNear | kLoose | kShared)) == 0) continue;
        if ((any & kNear) != 0) near.Of(task).push_back(static_cast<std::uint32_t>(t));
        for (std::size_t k = 0; k < 3; ++k)
          if ((StateOf(v[k]) & (kLoose | kShared)) != 0)
            corners.Of(task).push_back({v[k], static_cast<std::uint32_t>(3 * t + k)});
      }
    });
    doubtful = near.All();
    return AreClosedFans(corners.All());
  }

  bool AreClosedFans(std::vector<CornerAt> corners) const {
    std::sort(corners.begin(), corners.end());
    std::size_t fans = 0;
    std::vector<std::uint32_t> fan;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      fan.push_back(corners[i].corner);
      if (i + 1 < corners.size() && corners[i + 1].vertex == corners[i].vertex) continue;
      if (!IsClosedFan(mesh_, corners[i].vertex, fan)) return false;
      fan.clear();
      ++fans;
    }
    return fans == by_hand_.size();
  }

  /// Vertices that coincide are in one cell.
  std::int64_t CountCoincident() const {
    std::map<std::array<float, 3>, int> seen;
    std::int64_t count = 0;
    for (const std::uint32_t v : by_hand_) {
      if ((StateOf(v) & kShared) == 0) continue;
      const Eigen::Vector3f& p = mesh_.vertices[v];
      count += seen[{p.x(), p.y(), p.z()}]++ > 0 ? 1 : 0;
    }
    return count;
  }

  void Mark(std::size_t vertex, std::uint8_t bit) {
    state_[vertex].fetch_or(bit, std::memory_order_relaxed);
  }
  std::uint8_t StateOf(std::size_t vertex) const {
    return state_[vertex].load(std::memory_order_relaxed);
  }

  static constexpr int kMostCells = 256;                     // along a doubtful triangle's box
  static constexpr std::size_t kCellsATriangle = 4 * 4 * 3;  // and around it

  const Mesh& mesh_;
  LatticeCells cells_;
  std::size_t quads_;
  std::vector<std::atomic<std::uint8_t>> state_;  // of each vertex
  NotedEdges edges_;
  std::vector<RunOfVertices> runs_;
  std::vector<std::uint32_t> by_hand_;
  std::atomic<std::size_t> noted_ = 0;  // edges, at each of their four vertices
};

}  // namespace

std::optional<LatticeProof> ProveByLattice(const Mesh& mesh, const Lattice& lattice) {
  return Proof(mesh, lattice).Run();
}

}  // namespace lascaux

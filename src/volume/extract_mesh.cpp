#include "lascaux/volume/extract_mesh.h"

#include <fmt/format.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <new>
#include <optional>

#include "volume/arena.h"
#include "volume/block_vertices.h"
#include "volume/cell_vertices.h"
#include "volume/diagonals.h"
#include "volume/onto_surface.h"
#include "volume/shells.h"
#include "volume/sign_planes.h"
#include "volume/surface_cells.h"

namespace lascaux {
namespace {

using Eigen::Vector3f;

// By how much of a voxel a quadrilateral stays within reach of its edge before its vertices are
// rounded to their places in the model.
constexpr float kEnvelopeMargin = 1e-3F;

// How near to its cell's sides a vertex is moved, in voxels.
constexpr float kLeastInCell = 1e-3F;

/// The sides of a quadrilateral's two triangles in its corners, cut from the first corner or not,
/// and around an edge that starts inside or not: they are seen from outside.
constexpr std::array<std::array<std::array<std::uint8_t, 6>, 2>, 2> kTriangles = {
    {{{{0, 3, 1, 3, 2, 1}, {0, 1, 3, 1, 2, 3}}}, {{{0, 3, 2, 0, 2, 1}, {0, 1, 2, 0, 2, 3}}}}};

/// Where the vertices go: onto the field's surface, if there is one, in some cells or in all.
struct Target {
  const CompiledField* field = nullptr;
  const std::vector<VoxelMask>* cells = nullptr;

  bool Holds(std::size_t block, std::size_t cell) const {
    return cells == nullptr || ((*cells)[block][cell / 64] >> cell % 64 & 1) != 0;
  }
};

/// The mesh while it is made: vertices also as places in their cells, from 0 to 1.
class Extraction {
 public:
  Extraction(const NarrowBand& band, const Target& target)
      : band_(band),
        target_(target),
        cells_(FindSurfaceCells(band)),
        shells_(UnionFind::Unset(cells_.first_vertex.back())) {}

  Outcome<Mesh> Run() {
    const std::size_t vertices = cells_.first_vertex.back(), quads = cells_.first_quad.back();
    mesh_.vertices.resize(vertices);
    mesh_.triangles.resize(2 * quads);
    in_cell_.resize(vertices);
    if (target_.field != nullptr) mesh_.outward.resize(vertices);
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) {
      if (cells_.IsEmpty(b)) return;
      PlaceVertices(b);
      if (target_.field != nullptr) RefineVertices(b);
    });
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) {
      if (!cells_.IsEmpty(b)) ConnectVertices(b);
    });
    JoinShells();
    return KeepBody();
  }

 private:
  using Pairs = std::vector<std::array<std::uint32_t, 2>>;

  void PlaceVertices(std::size_t block) {
    const CellVertices vertices(band_, cells_.above[block]);
    const bool is_single = cells_.HasSinglePieces(block);
    std::uint32_t vertex = cells_.first_vertex[block];
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      const CellSigns signs = cells_.signs[number];
      const CellPieces& pieces = is_single ? PiecesJoined(signs) : cells_.Pieces(number);
      if (pieces.count == 1) {
        SetVertex(vertex++, block, InBlock(cell), vertices.InOnePiece(cell, signs));
        return;
      }
      const std::array<Vector3f, 4> means = vertices.In(cell, pieces);
      for (std::size_t p = 0; p < pieces.count; ++p)
        SetVertex(vertex++, block, InBlock(cell), means[p]);
    });
  }

  /// Moves vertices that are alone in their cells onto the field's surface, within their cells.
  void RefineVertices(std::size_t block) {
    std::vector<Vector3f> places;
    std::vector<std::uint32_t> which;
    std::vector<Eigen::Vector3i> cells;
    const bool is_single = cells_.HasSinglePieces(block);
    std::uint32_t vertex = cells_.first_vertex[block];
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      const std::uint32_t pieces = is_single ? 1 : cells_.Pieces(number).count, first = vertex;
      vertex += pieces;
      if (pieces != 1 || !target_.Holds(block, cell)) {
        std::fill_n(mesh_.outward.begin() + first, pieces, Vector3f::Zero());
        return;
      }
      which.push_back(first);
      cells.push_back(InBlock(cell));
      places.push_back(cells.back().cast<float>() + in_cell_[first]);
    });
    const BlockPoints points = MoveOntoSurface(*target_.field, band_, block, std::move(places));
    for (std::size_t i = 0; i < which.size(); ++i) {
      mesh_.outward[which[i]] = points.outward[i];
      const Vector3f in_cell = points.places[i] - cells[i].cast<float>();
      if (in_cell.minCoeff() < kLeastInCell || in_cell.maxCoeff() > 1 - kLeastInCell) continue;
      SetVertex(which[i], block, cells[i], in_cell);
    }
  }

  static Eigen::Vector3i InBlock(std::size_t cell) {
    return {static_cast<int>(cell / 64), static_cast<int>(cell / 8 % 8),
            static_cast<int>(cell % 8)};
  }

  void SetVertex(std::size_t vertex, std::size_t block, const Eigen::Vector3i& cell,
                 const Vector3f& in_cell) {
    const Eigen::Vector3d lowest = (band_.blocks[block] + cell).cast<double>();
    in_cell_[vertex] = in_cell;
    mesh_.vertices[vertex] =
        (band_.origin + band_.voxel_size * (lowest + in_cell.cast<double>())).cast<float>();
  }

  /// Quadrilaterals that wait for their diagonals.
  struct Waiting {
    SeenQuads seen;
    std::array<std::array<std::uint32_t, 4>, SeenQuads::kMost> vertices;
    std::array<std::uint8_t, SeenQuads::kMost> starts_inside;
    std::size_t first, count = 0;
  };

  void ConnectVertices(std::size_t block) {
    BlockVertices around(cells_, block);
    for (const std::uint32_t v : around.Vertices()) __builtin_prefetch(in_cell_.data() + v);
    Pairs& pairs = pairs_.local();
    Waiting waiting;
    waiting.first = cells_.first_quad[block];
    ForLayers(cells_, block, [&](std::size_t x, const SignPlanes& low, const SignPlanes& high) {
      const std::array<UpperEdges, 3> edges = UpperEdgesOf(low, high);
      const auto add = [&]<int kAxis>(const UpperEdges& along) {
        for (std::uint64_t word = along.crossed; word != 0; word &= word - 1) {
          const auto i = static_cast<std::size_t>(std::countr_zero(word));
          const std::size_t place = BlockVertices::PlaceOf(64 * x + i);
          waiting.starts_inside[waiting.count] = along.starts_inside >> i & 1;
          AddQuad<kAxis>(around, place, waiting, pairs);
        }
      };
      add.template operator()<0>(edges[0]);
      add.template operator()<1>(edges[1]);
      add.template operator()<2>(edges[2]);
    });
    Cut(waiting);
    around.Tell(shells_, pairs);
  }

  /// The quadrilateral around the edge along an axis that ends in the upper corner of the cell at
  /// a place.
  template <int kAxis>
  void AddQuad(BlockVertices& around, std::size_t place, Waiting& waiting, Pairs& pairs) {
    constexpr std::size_t kU = BlockVertices::kStride[(kAxis + 1) % 3];
    constexpr std::size_t kW = BlockVertices::kStride[(kAxis + 2) % 3];
    // From the cell itself counter-clockwise, seen from where the axis points to.
    const std::array<std::size_t, 4> places = {place, place + kU, place + kU + kW, place + kW};
    using Local = BlockVertices::Local;
    const Local a = around.At(places[0]), b = around.At(places[1]), c = around.At(places[2]),
                d = around.At(places[3]);
    std::array<std::uint32_t, 4>& vertices = waiting.vertices[waiting.count];
    if (!BlockVertices::IsAnySeveral(a | b | c | d)) {
      vertices = {around.Vertex(a), around.Vertex(b), around.Vertex(c), around.Vertex(d)};
      around.Join(a, b);
      around.Join(a, c);
      around.Join(a, d);
    } else {
      // The edge is the upper one of its cell, and the lower one of those beyond.
      constexpr std::array<std::size_t, 4> kEdges = {CellEdge(kAxis, 1, 1), CellEdge(kAxis, 0, 1),
                                                     CellEdge(kAxis, 0, 0), CellEdge(kAxis, 1, 0)};
      for (std::size_t k = 0; k < 4; ++k) vertices[k] = around.VertexAtEdge(places[k], kEdges[k]);
      for (std::size_t k = 1; k < 4; ++k) pairs.push_back({vertices[0], vertices[k]});
    }
    SeeCorner<kAxis, 0, -1, -1>(vertices[0], waiting);
    SeeCorner<kAxis, 1, 0, -1>(vertices[1], waiting);
    SeeCorner<kAxis, 2, 0, 0>(vertices[2], waiting);
    SeeCorner<kAxis, 3, -1, 0>(vertices[3], waiting);
    if (++waiting.count == SeenQuads::kMost) Cut(waiting);
  }

  template <int kAxis, std::size_t kCorner, int kX, int kY>
  void SeeCorner(std::uint32_t vertex, Waiting& waiting) const {
    const float* const at = in_cell_[vertex].data();
    SeenQuads::Corners& seen = waiting.seen.corners[kCorner];
    seen.x[waiting.count] = at[(kAxis + 1) % 3] + static_cast<float>(kX);
    seen.y[waiting.count] = at[(kAxis + 2) % 3] + static_cast<float>(kY);
    seen.height[waiting.count] = at[kAxis];
  }

  /// Cuts what waits into triangles.
  void Cut(Waiting& waiting) {
    const auto from_first = CutFromFirst(waiting.seen, waiting.count, kEnvelopeMargin);
    for (std::size_t i = 0; i < waiting.count; ++i) {
      const std::array<std::uint32_t, 4>& q = waiting.vertices[i];
      const std::array<std::uint8_t, 6>& of = kTriangles[from_first[i]][waiting.starts_inside[i]];
      auto* const triangles = mesh_.triangles.data() + 2 * (waiting.first + i);
      triangles[0] = {q[of[0]], q[of[1]], q[of[2]]};
      triangles[1] = {q[of[3]], q[of[4]], q[of[5]]};
    }
    waiting.first += waiting.count;
    waiting.count = 0;
  }

  void JoinShells() {
    pairs_.combine_each([this](const Pairs& pairs) {
      tbb::parallel_for(std::size_t{0}, pairs.size(),
                        [&](std::size_t i) { shells_.Join(pairs[i][0], pairs[i][1]); });
    });
  }

  Outcome<Mesh> KeepBody() {
    const auto vertices = static_cast<std::uint32_t>(mesh_.vertices.size());
    std::uint32_t v = 1;
    while (v < vertices && !shells_.IsRoot(v)) ++v;
    // A single shell is a body where what is beyond its farthest cell is outside.
    if (v >= vertices && vertices > 0 && IsOutsideBeyond()) return Outcome<Mesh>(std::move(mesh_));
    return KeepLargestShell(std::move(mesh_), band_.voxel_size, shells_);
  }

  bool IsOutsideBeyond() const {
    std::size_t farthest = band_.size();
    for (std::size_t b = 0; b < band_.size(); ++b) {
      if (cells_.IsEmpty(b)) continue;
      if (farthest == band_.size() || band_.blocks[b].x() > band_.blocks[farthest].x())
        farthest = b;
    }
    // In a block, cells are in the order of x; the next one's corners are all on one side.
    return (cells_.signs[cells_.first[farthest + 1] - 1] & 2) == 0;
  }

  const NarrowBand& band_;
  Target target_;
  SurfaceCells cells_;
  UnionFind shells_;
  tbb::combinable<Pairs> pairs_;  // of vertices that are connected, beside those in one block
  Mesh mesh_;
  std::vector<Vector3f> in_cell_;
};

Outcome<Mesh> Extract(const NarrowBand& band, const Target& target, const Execution& execution) {
  using Result = Outcome<Mesh>;
  const auto cancelled = [] {
    return Error(FailureKind::kInterrupted, "cancelled", "the run was stopped");
  };
  if (execution.IsCancelled()) return Result::Failure(cancelled());
  try {
    std::optional<Result> result;
    RunInArena(execution, [&] { result = Extraction(band, target).Run(); });
    if (execution.IsCancelled()) return Result::Failure(cancelled());
    return std::move(*result);
  } catch (const std::bad_alloc&) {
    return Result::Failure(Error(
        FailureKind::kUsage, "out-of-memory",
        fmt::format("a mesh of {} active voxels does not fit in memory: ask for larger voxels",
                    CountActive(band))));
  }
}

}  // namespace

Outcome<Mesh> ExtractMesh(const NarrowBand& band, const Execution& execution) {
  return Extract(band, {}, execution);
}

Outcome<Mesh> ExtractMesh(const NarrowBand& band, const Field& field, const Execution& execution) {
  const CompiledField compiled(field);
  return Extract(band, {&compiled}, execution);
}

Outcome<Mesh> ExtractMesh(const NarrowBand& band, const Field& field,
                          const std::vector<VoxelMask>& cells, const Execution& execution) {
  const CompiledField compiled(field);
  return Extract(band, {&compiled, &cells}, execution);
}

}  // namespace lascaux

#include "lascaux/volume/extract_mesh.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "volume/arena.h"
#include "volume/cell_vertices.h"
#include "volume/diagonals.h"
#include "volume/onto_surface.h"
#include "volume/shells.h"
#include "volume/surface_cells.h"

namespace lascaux {
namespace {

using Eigen::Vector3f;

// By how much of a voxel a quadrilateral stays within reach of its edge before its vertices are
// rounded to their places in the model.
constexpr float kEnvelopeMargin = 1e-3F;

// How near to its cell's sides a vertex is moved, in voxels.
constexpr float kLeastInCell = 1e-3F;

constexpr std::array<std::size_t, 3> kStride = {64, 8, 1};

/// Numbers of the first vertex of each cell and of the first quadrilateral of each block, with one
/// more at the end.
struct Numbering {
  std::vector<std::uint32_t> vertex, quad;
};

/// Is the edge along `axis` that ends in a cell's upper corner crossed? Each edge is for the cell
/// whose uppermost it is.
bool IsUpperEdgeCrossed(CellSigns signs, int axis) {
  return ((signs >> 7 ^ signs >> (7 ^ 1 << axis)) & 1) != 0;
}

constexpr std::uint32_t kSeveral = ~std::uint32_t{0};

/// The vertex of each of a block's crossed cells, or kSeveral; of others nothing.
struct BlockVertices {
  std::array<std::uint32_t, kBlockVoxels> of;

  BlockVertices(const SurfaceCells& cells, const Numbering& numbering, std::size_t block) {
    cells.ForCells(block, [&](std::size_t cell, std::size_t number) {
      const std::uint32_t vertex = numbering.vertex[number];
      of[cell] = numbering.vertex[number + 1] - vertex == 1 ? vertex : kSeveral;
    });
  }
};

Numbering NumberParts(const SurfaceCells& cells) {
  const std::size_t blocks = cells.crossed.size();
  Numbering numbering;
  numbering.vertex.resize(cells.signs.size() + 1);
  numbering.quad.resize(blocks + 1);
  std::vector<std::uint32_t> vertices(blocks + 1);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    std::uint32_t vertex = 0, quad = 0;
    for (std::size_t n = cells.first[b]; n < cells.first[b + 1]; ++n) {
      numbering.vertex[n] = vertex;
      vertex += cells.Pieces(n).count;
      for (int axis = 0; axis < 3; ++axis) quad += IsUpperEdgeCrossed(cells.signs[n], axis) ? 1 : 0;
    }
    vertices[b + 1] = vertex;
    numbering.quad[b + 1] = quad;
  });
  for (std::size_t b = 0; b < blocks; ++b) {
    vertices[b + 1] += vertices[b];
    numbering.quad[b + 1] += numbering.quad[b];
  }
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    for (std::size_t n = cells.first[b]; n < cells.first[b + 1]; ++n)
      numbering.vertex[n] += vertices[b];
  });
  numbering.vertex.back() = vertices.back();
  return numbering;
}

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
        numbering_(NumberParts(cells_)),
        shells_(numbering_.vertex.back()) {}

  Outcome<Mesh> Run() {
    const std::size_t vertices = numbering_.vertex.back(), quads = numbering_.quad.back();
    mesh_.vertices.resize(vertices);
    mesh_.triangles.resize(2 * quads);
    in_cell_.resize(vertices);
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) {
      PlaceVertices(b);
      if (target_.field != nullptr) RefineVertices(b);
    });
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) { ConnectVertices(b); });
    return KeepLargestShell(std::move(mesh_), band_.voxel_size, shells_);
  }

 private:
  void PlaceVertices(std::size_t block) {
    if (cells_.first[block] == cells_.first[block + 1]) return;
    const CellVertices vertices(band_, cells_.above[block]);
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      const CellPieces& pieces = cells_.Pieces(number);
      const std::array<Vector3f, 4> means = vertices.In(cell, cells_.signs[number], pieces);
      for (std::size_t p = 0; p < pieces.count; ++p)
        SetVertex(numbering_.vertex[number] + p, block, InBlock(cell), means[p]);
    });
  }

  /// Moves vertices that are alone in their cells onto the field's surface, within their cells.
  void RefineVertices(std::size_t block) {
    BlockPlaces places;
    std::vector<std::uint32_t> which;
    std::vector<Eigen::Vector3i> cells;
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      if (cells_.Pieces(number).count != 1 || !target_.Holds(block, cell)) return;
      which.push_back(numbering_.vertex[number]);
      cells.push_back(InBlock(cell));
      places.push_back(cells.back().cast<float>() + in_cell_[which.back()]);
    });
    MoveOntoSurface(*target_.field, band_, block, places);
    for (std::size_t i = 0; i < which.size(); ++i) {
      const Vector3f in_cell = places[i] - cells[i].cast<float>();
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
    if (cells_.first[block] == cells_.first[block + 1]) return;
    const BlockVertices own(cells_, numbering_, block);
    Waiting waiting;
    waiting.first = numbering_.quad[block];
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      const CellSigns signs = cells_.signs[number];
      const InBlockCell here{block, cell, own};
      if (IsUpperEdgeCrossed(signs, 0)) AddQuad<0>(here, signs, waiting);
      if (IsUpperEdgeCrossed(signs, 1)) AddQuad<1>(here, signs, waiting);
      if (IsUpperEdgeCrossed(signs, 2)) AddQuad<2>(here, signs, waiting);
    });
    Cut(waiting);
  }

  /// A cell, with the vertices of its block.
  struct InBlockCell {
    std::size_t block, cell;
    const BlockVertices& own;
  };

  /// The quadrilateral around the edge along an axis that ends in the cell's upper corner.
  template <int kAxis>
  void AddQuad(const InBlockCell& here, CellSigns signs, Waiting& waiting) {
    const std::size_t i = waiting.count++;
    waiting.starts_inside[i] = signs >> (7 ^ 1 << kAxis) & 1;
    // From the cell itself counter-clockwise, seen from where the axis points to.
    AddCorner<kAxis, 0, 0>(here, 0, waiting);
    AddCorner<kAxis, 1, 0>(here, 1, waiting);
    AddCorner<kAxis, 1, 1>(here, 2, waiting);
    AddCorner<kAxis, 0, 1>(here, 3, waiting);
    if (waiting.count == SeenQuads::kMost) Cut(waiting);
  }

  /// Corner `k` of the last quadrilateral, in the cell one step beyond along the next two axes or
  /// not.
  template <int kAxis, int kU, int kW>
  void AddCorner(const InBlockCell& here, std::size_t k, Waiting& waiting) const {
    const std::size_t i = waiting.count - 1;
    const std::uint32_t vertex = CornerVertex<kAxis, kU, kW>(here);
    const float* const at = in_cell_[vertex].data();
    waiting.vertices[i][k] = vertex;
    SeenQuads::Corners& seen = waiting.seen.corners[k];
    seen.x[i] = at[(kAxis + 1) % 3] + (kU - 1);
    seen.y[i] = at[(kAxis + 2) % 3] + (kW - 1);
    seen.height[i] = at[kAxis];
  }

  template <int kAxis, int kU, int kW>
  std::uint32_t CornerVertex(const InBlockCell& here) const {
    std::size_t at = here.cell, side = 0;
    if constexpr (kU == 1) StepUp<(kAxis + 1) % 3>(at, side);
    if constexpr (kW == 1) StepUp<(kAxis + 2) % 3>(at, side);
    if (side == 0 && here.own.of[at] != kSeveral) return here.own.of[at];
    const std::size_t number =
        cells_.Number(static_cast<std::size_t>(cells_.above[here.block][side]), at);
    const std::uint32_t vertex = numbering_.vertex[number];
    if (numbering_.vertex[number + 1] - vertex == 1) return vertex;
    // The edge is the upper one of its cell, and the lower one of those beyond.
    return vertex + cells_.Pieces(number).of_edge[CellEdge(kAxis, 1 - kU, 1 - kW)];
  }

  template <int kAlong>
  static void StepUp(std::size_t& cell, std::size_t& side) {
    constexpr std::size_t kStep = kStride[kAlong];
    const bool is_beyond = cell / kStep % 8 == 7;
    cell = is_beyond ? cell - 7 * kStep : cell + kStep;
    side |= static_cast<std::size_t>(is_beyond) << kAlong;
  }

  /// Cuts what waits into triangles.
  void Cut(Waiting& waiting) {
    const auto from_first = CutFromFirst(waiting.seen, waiting.count, kEnvelopeMargin);
    for (std::size_t i = 0; i < waiting.count; ++i) {
      const std::array<std::uint32_t, 4>& q = waiting.vertices[i];
      AddTriangles(2 * (waiting.first + i), q, from_first[i] != 0, waiting.starts_inside[i] != 0);
      for (std::size_t k = 1; k < 4; ++k) shells_.Join(q[0], q[k]);
    }
    waiting.first += waiting.count;
    waiting.count = 0;
  }

  void AddTriangles(std::size_t at, std::array<std::uint32_t, 4> q, bool from_first,
                    bool starts_inside) {
    // Seen from outside, which is where the edge points to when it starts inside.
    if (!starts_inside) std::swap(q[1], q[3]);
    if (from_first) {
      mesh_.triangles[at] = {q[0], q[1], q[2]};
      mesh_.triangles[at + 1] = {q[0], q[2], q[3]};
    } else {
      mesh_.triangles[at] = {q[0], q[1], q[3]};
      mesh_.triangles[at + 1] = {q[1], q[2], q[3]};
    }
  }

  const NarrowBand& band_;
  Target target_;
  SurfaceCells cells_;
  Numbering numbering_;
  UnionFind shells_;
  Mesh mesh_;
  std::vector<Vector3f> in_cell_;
};

}  // namespace

namespace {

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

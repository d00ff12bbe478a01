#include "lascaux/volume/extract_mesh.h"

#include <fmt/format.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <new>
#include <optional>
#include <span>

#include "lascaux/base/arena.h"
#include "volume/block_frame.h"
#include "volume/block_quads.h"
#include "volume/cell_shells.h"
#include "volume/cell_vertices.h"
#include "volume/onto_surface.h"
#include "volume/shells.h"
#include "volume/surface_cells.h"

namespace lascaux {
namespace {

using Eigen::Vector3f;

// How near to its cell's sides a vertex is moved, in voxels.
constexpr float kLeastInCell = 1e-3F;

/// Where the vertices go: onto the field's surface, if there is one, in some cells or in all.
struct Target {
  const CompiledField* field = nullptr;
  const std::vector<VoxelMask>* cells = nullptr;

  bool Holds(std::size_t block, std::size_t cell) const {
    return cells == nullptr || ((*cells)[block][cell / 64] >> cell % 64 & 1) != 0;
  }
};

/// Four of a block's points from one on; those that are not there are the last.
struct FourVertices {
  FourCells cells;
  std::array<std::size_t, 4> vertices;

  FourVertices(const BlockPoints& points, std::span<const std::uint32_t> of_points, std::size_t at)
      : cells(FourInts{points.cells[std::min(at, points.count - 1)],
                       points.cells[std::min(at + 1, points.count - 1)],
                       points.cells[std::min(at + 2, points.count - 1)],
                       points.cells[std::min(at + 3, points.count - 1)]}) {
    for (std::size_t i = 0; i < 4; ++i) vertices[i] = of_points[std::min(at + i, points.count - 1)];
  }

  std::array<float*, 4> In(std::vector<Vector3f>& of) const {
    return {of[vertices[0]].data(), of[vertices[1]].data(), of[vertices[2]].data(),
            of[vertices[3]].data()};
  }
};

/// The mesh while it is made: vertices are places in their cells, from 0 to 1, until all are
/// connected.
class Extraction {
 public:
  Extraction(const NarrowBand& band, const Target& target)
      : band_(band), target_(target), cells_(FindSurfaceCells(band)) {
    missing_.fill(band.background);
  }

  Outcome<Mesh> Run() {
    const std::size_t vertices = cells_.first_vertex.back(), quads = cells_.first_quad.back();
    mesh_.vertices.resize(vertices);
    mesh_.triangles.resize(2 * quads);
    if (target_.field != nullptr) mesh_.outward.resize(vertices);
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) {
      if (cells_.IsEmpty(b)) return;
      const CellList cells = CellsOf(b);
      PlaceVertices(b, cells.All());
      if (target_.field != nullptr) RefineVertices(b, cells.All());
    });
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) {
      if (!cells_.IsEmpty(b)) ConnectVertices(b);
    });
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) {
      if (!cells_.IsEmpty(b)) TakeToModel(b);
    });
    return KeepBody();
  }

 private:
  /// Asks for the distances that a block's vertices will be placed by.
  void Prefetch(std::size_t block) const {
    if (block >= band_.size()) return;
    for (const std::size_t side : {std::size_t{0}, std::size_t{4}}) {
      const std::int32_t found = cells_.above[block][side];
      if (found == kNoBlock) continue;
      const float* const values =
          band_.values.data() + kBlockVoxels * static_cast<std::size_t>(found);
      for (std::size_t x = 0; x < 8; ++x) {
        if (cells_.crossed[block][x] == 0) continue;
        for (std::size_t i = 0; i < 64; i += 16) __builtin_prefetch(values + 64 * x + i);
      }
    }
  }

  /// A block's crossed cells.
  struct CellList {
    std::array<std::uint16_t, kBlockVoxels> cells;
    std::size_t count = 0;

    std::span<const std::uint16_t> All() const { return {cells.data(), count}; }
  };

  CellList CellsOf(std::size_t block) const {
    CellList list;
    cells_.ForCells(block, [&](std::size_t cell, std::size_t) {
      list.cells[list.count++] = static_cast<std::uint16_t>(cell);
    });
    return list;
  }

  void PlaceVertices(std::size_t block, std::span<const std::uint16_t> cells) {
    Prefetch(block + 2);
    const CellVertices vertices(band_, cells_, block, missing_);
    const std::size_t first = cells_.first_vertex[block];
    const CellSigns* const signs = cells_.signs.data() + cells_.first[block];
    vertices.PlaceMeans(cells, signs, mesh_.vertices.data() + first);
    if (cells_.HasSinglePieces(block)) return;
    // Cells with several pieces have more vertices, which those behind make room for.
    std::size_t vertex = cells_.first_vertex[block + 1];
    for (std::size_t i = cells.size(); i-- > 0;) {
      const CellPieces& pieces = cells_.Pieces(cells_.first[block] + i);
      vertex -= pieces.count;
      mesh_.vertices[vertex] = mesh_.vertices[first + i];
      if (pieces.count == 1) continue;
      const std::array<Vector3f, 4> means = vertices.In(cells[i], pieces);
      for (std::size_t p = 0; p < pieces.count; ++p) mesh_.vertices[vertex + p] = means[p];
    }
  }

  /// Moves vertices that are alone in their cells onto the field's surface, within their cells.
  void RefineVertices(std::size_t block, std::span<const std::uint16_t> cells) {
    const bool is_single = cells_.HasSinglePieces(block);
    BlockPoints points;
    std::array<std::uint32_t, kBlockVoxels> vertices;
    std::uint32_t vertex = cells_.first_vertex[block];
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::uint32_t pieces = is_single ? 1 : cells_.Pieces(cells_.first[block] + i).count;
      if (pieces == 1 && target_.Holds(block, cells[i])) {
        points.cells[points.count] = cells[i];
        vertices[points.count++] = vertex;
      } else {
        std::fill_n(mesh_.outward.begin() + vertex, pieces, Vector3f::Zero());
      }
      vertex += pieces;
    }
    if (points.count == 0) return;
    for (std::size_t at = 0; at < points.count; at += 4) {
      const FourVertices four(points, vertices, at);
      const FourPoints in_cell = Gather(four.In(mesh_.vertices));
      StoreFour(__builtin_convertvector(four.cells.x, Four) + in_cell.x, points.x.data() + at);
      StoreFour(__builtin_convertvector(four.cells.y, Four) + in_cell.y, points.y.data() + at);
      StoreFour(__builtin_convertvector(four.cells.z, Four) + in_cell.z, points.z.data() + at);
    }
    points.MoveOntoSurface(*target_.field, band_, block);
    for (std::size_t at = 0; at < points.count; at += 4) {
      const FourVertices four(points, vertices, at);
      Scatter({LoadFour(points.outward_x.data() + at), LoadFour(points.outward_y.data() + at),
               LoadFour(points.outward_z.data() + at)},
              four.In(mesh_.outward));
      const Four x = LoadFour(points.x.data() + at) - __builtin_convertvector(four.cells.x, Four);
      const Four y = LoadFour(points.y.data() + at) - __builtin_convertvector(four.cells.y, Four);
      const Four z = LoadFour(points.z.data() + at) - __builtin_convertvector(four.cells.z, Four);
      const FourInts leaves = (x < kLeastInCell) | (x > 1 - kLeastInCell) | (y < kLeastInCell) |
                              (y > 1 - kLeastInCell) | (z < kLeastInCell) | (z > 1 - kLeastInCell);
      const FourPoints old = Gather(four.In(mesh_.vertices));
      Scatter({leaves ? old.x : x, leaves ? old.y : y, leaves ? old.z : z},
              four.In(mesh_.vertices));
    }
  }

  void ConnectVertices(std::size_t block) {
    const VertexPairs pairs =
        ConnectAroundEdges(cells_, block,
                           {mesh_.vertices.data(),
                            mesh_.triangles.data() + 2 * std::size_t{cells_.first_quad[block]}});
    if (pairs.empty()) return;
    VertexPairs& all = pairs_.local();
    all.insert(all.end(), pairs.begin(), pairs.end());
  }

  void TakeToModel(std::size_t block) {
    const CellList list = CellsOf(block);
    Vector3f* const vertices = mesh_.vertices.data() + cells_.first_vertex[block];
    if (cells_.HasSinglePieces(block)) return PlaceInModel(band_, block, list.All(), vertices);
    std::vector<std::uint16_t> cells;  // of each vertex
    for (std::size_t i = 0; i < list.count; ++i)
      cells.insert(cells.end(), cells_.Pieces(cells_.first[block] + i).count, list.cells[i]);
    PlaceInModel(band_, block, cells, vertices);
  }

  Outcome<Mesh> KeepBody() {
    VertexPairs pairs;
    pairs_.combine_each(
        [&](const VertexPairs& some) { pairs.insert(pairs.end(), some.begin(), some.end()); });
    // A single shell is a body where what is beyond its farthest cell is outside.
    if (IsOneShell(cells_, pairs) && IsOutsideBeyond()) return Outcome<Mesh>(std::move(mesh_));
    return KeepLargestShell(std::move(mesh_), band_.voxel_size);
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
  BlockValues missing_;
  tbb::combinable<VertexPairs> pairs_;
  Mesh mesh_;
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

#include "lascaux/volume/extract_mesh.h"

#include <fmt/format.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <new>
#include <optional>

#include "lascaux/base/arena.h"
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
      PlaceVertices(b);
      if (target_.field != nullptr) RefineVertices(b);
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
    for (const std::size_t side : {0, 4}) {
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

  void PlaceVertices(std::size_t block) {
    Prefetch(block + 2);
    const CellVertices vertices(band_, cells_, block, missing_);
    std::array<std::uint16_t, kBlockVoxels> cells;
    std::size_t count = 0;
    cells_.ForCells(block, [&](std::size_t cell, std::size_t) {
      cells[count++] = static_cast<std::uint16_t>(cell);
    });
    const std::size_t first = cells_.first_vertex[block];
    const CellSigns* const signs = cells_.signs.data() + cells_.first[block];
    vertices.PlaceMeans({cells.data(), count}, signs, mesh_.vertices.data() + first);
    if (cells_.HasSinglePieces(block)) return;
    // Cells with several pieces have more vertices, which those behind make room for.
    std::size_t vertex = cells_.first_vertex[block + 1];
    for (std::size_t i = count; i-- > 0;) {
      const CellPieces& pieces = cells_.Pieces(cells_.first[block] + i);
      vertex -= pieces.count;
      mesh_.vertices[vertex] = mesh_.vertices[first + i];
      if (pieces.count == 1) continue;
      const std::array<Vector3f, 4> means = vertices.In(cells[i], pieces);
      for (std::size_t p = 0; p < pieces.count; ++p) mesh_.vertices[vertex + p] = means[p];
    }
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
      places.push_back(cells.back().cast<float>() + mesh_.vertices[first]);
    });
    const BlockPoints points = MoveOntoSurface(*target_.field, band_, block, std::move(places));
    for (std::size_t i = 0; i < which.size(); ++i) {
      mesh_.outward[which[i]] = points.outward[i];
      const Vector3f in_cell = points.places[i] - cells[i].cast<float>();
      if (in_cell.minCoeff() < kLeastInCell || in_cell.maxCoeff() > 1 - kLeastInCell) continue;
      mesh_.vertices[which[i]] = in_cell;
    }
  }

  static Eigen::Vector3i InBlock(std::size_t cell) {
    return {static_cast<int>(cell / 64), static_cast<int>(cell / 8 % 8),
            static_cast<int>(cell % 8)};
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
    const bool is_single = cells_.HasSinglePieces(block);
    std::vector<std::uint16_t> cells;  // of each vertex
    cells.reserve(kBlockVoxels);
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      cells.insert(cells.end(), is_single ? 1 : cells_.Pieces(number).count,
                   static_cast<std::uint16_t>(cell));
    });
    PlaceInModel(band_, block, cells, mesh_.vertices.data() + cells_.first_vertex[block]);
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

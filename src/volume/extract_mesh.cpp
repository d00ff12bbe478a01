#include "lascaux/volume/extract_mesh.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "volume/arena.h"
#include "volume/envelope.h"
#include "volume/finish_band.h"
#include "volume/onto_surface.h"
#include "volume/shells.h"
#include "volume/surface_cells.h"

namespace lascaux {
namespace {

using Eigen::Vector3f;

// By how much of a voxel a quadrilateral stays within reach of its edge before its vertices are
// rounded to their places in the model.
constexpr double kEnvelopeMargin = 1e-3;

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

Numbering NumberParts(const SurfaceCells& cells) {
  Numbering numbering;
  numbering.vertex.resize(cells.signs.size() + 1);
  numbering.quad.resize(cells.crossed.size() + 1);
  std::uint32_t vertices = 0, quads = 0;
  for (std::size_t b = 0; b < cells.crossed.size(); ++b) {
    numbering.quad[b] = quads;
    for (std::size_t n = cells.first[b]; n < cells.first[b + 1]; ++n) {
      numbering.vertex[n] = vertices;
      vertices += cells.Pieces(n).count;
      for (int axis = 0; axis < 3; ++axis)
        quads += IsUpperEdgeCrossed(cells.signs[n], axis) ? 1 : 0;
    }
  }
  numbering.vertex.back() = vertices;
  numbering.quad.back() = quads;
  return numbering;
}

/// Values at the corners of a block's cells.
class CornerValues {
 public:
  CornerValues(const NarrowBand& band, const BlocksAbove& above)
      : least_(kLeastDistance * static_cast<float>(band.voxel_size)), missing_(band.background) {
    for (std::size_t side = 0; side < 8; ++side) {
      values_[side] =
          above[side] == kNoBlock
              ? nullptr
              : band.values.data() + kBlockVoxels * static_cast<std::size_t>(above[side]);
    }
  }

  /// Of a cell, no one so close to 0 that vertices could fall on one point.
  std::array<float, 8> Of(std::size_t cell, CellSigns signs) const {
    std::array<float, 8> corners;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      std::size_t voxel = cell, side = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) == 0) continue;
        const bool is_beyond = voxel / kStride[axis] % 8 == 7;
        voxel = is_beyond ? voxel - 7 * kStride[axis] : voxel + kStride[axis];
        side |= static_cast<std::size_t>(is_beyond) << axis;
      }
      const float* const block = values_[side];
      const float size = std::max(block == nullptr ? missing_ : std::abs(block[voxel]), least_);
      corners[corner] = (signs >> corner & 1) != 0 ? -size : size;
    }
    return corners;
  }

 private:
  float least_, missing_;
  std::array<const float*, 8> values_;
};

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
        numbering_(NumberParts(cells_)) {}

  Mesh Run() {
    const std::size_t vertices = numbering_.vertex.back(), quads = numbering_.quad.back();
    mesh_.vertices.resize(vertices);
    mesh_.triangles.resize(2 * quads);
    in_cell_.resize(vertices);
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) {
      PlaceVertices(b);
      if (target_.field != nullptr) RefineVertices(b);
    });
    tbb::parallel_for(std::size_t{0}, band_.size(), [this](std::size_t b) { ConnectVertices(b); });
    return std::move(mesh_);
  }

 private:
  void PlaceVertices(std::size_t block) {
    const CornerValues values(band_, cells_.above[block]);
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      const std::array<float, 8> corners = values.Of(cell, cells_.signs[number]);
      const CellPieces& pieces = cells_.Pieces(number);
      std::array<Vector3f, 4> sum;
      std::array<float, 4> count{};
      for (std::size_t p = 0; p < pieces.count; ++p) sum[p].setZero();
      for (int axis = 0; axis < 3; ++axis) {
        for (int place = 0; place < 4; ++place) {
          const int u = place & 1, w = place >> 1;
          const std::uint8_t piece = pieces.of_edge[CellEdge(axis, u, w)];
          if (piece == kNotCrossed) continue;
          const int along_u = (axis + 1) % 3, along_w = (axis + 2) % 3;
          const auto start = static_cast<std::size_t>(u << along_u | w << along_w);
          const float a = corners[start], b = corners[start | std::size_t{1} << axis];
          sum[piece][axis] += a / (a - b);
          sum[piece][along_u] += static_cast<float>(u);
          sum[piece][along_w] += static_cast<float>(w);
          count[piece] += 1;
        }
      }
      for (std::size_t p = 0; p < pieces.count; ++p)
        SetVertex(numbering_.vertex[number] + p, block, InBlock(cell), sum[p] / count[p]);
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

  void ConnectVertices(std::size_t block) {
    std::size_t quad = numbering_.quad[block];
    cells_.ForCells(block, [&](std::size_t cell, std::size_t number) {
      for (int axis = 0; axis < 3; ++axis) {
        const CellSigns signs = cells_.signs[number];
        if (!IsUpperEdgeCrossed(signs, axis)) continue;
        const bool starts_inside = (signs >> (7 ^ 1 << axis) & 1) != 0;
        const std::array<std::uint32_t, 4> corners = Corners(block, cell, axis);
        const bool from_first = CutsFromFirst(corners, axis);
        AddTriangles(2 * quad++, corners, from_first, starts_inside);
      }
    });
  }

  /// The vertices around the edge along `axis` that ends in the cell's upper corner: of the cell
  /// itself, then counter-clockwise seen from where the axis points to.
  std::array<std::uint32_t, 4> Corners(std::size_t block, std::size_t cell, int axis) const {
    std::array<std::uint32_t, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const int u = k == 1 || k == 2 ? 1 : 0, w = k >= 2 ? 1 : 0;
      std::size_t at = cell, side = 0;
      for (const auto& [step, along] :
           {std::pair(u, (axis + 1) % 3), std::pair(w, (axis + 2) % 3)}) {
        if (step == 0) continue;
        const std::size_t stride = kStride[static_cast<std::size_t>(along)];
        const bool is_beyond = at / stride % 8 == 7;
        at = is_beyond ? at - 7 * stride : at + stride;
        side |= static_cast<std::size_t>(is_beyond) << along;
      }
      const auto in = static_cast<std::size_t>(cells_.above[block][side]);
      const std::size_t number = cells_.Number(in, at);
      // The edge is the upper one of this cell, and the lower one of those beyond.
      corners[k] =
          numbering_.vertex[number] + cells_.Pieces(number).of_edge[CellEdge(axis, 1 - u, 1 - w)];
    }
    return corners;
  }

  /// Is the diagonal from the first corner the better one?
  bool CutsFromFirst(const std::array<std::uint32_t, 4>& q, int axis) const {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    std::array<SeenCorner, 4> seen;
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d at = in_cell_[q[k]].cast<double>();
      seen[k] = {at[u] - (k == 1 || k == 2 ? 0 : 1), at[w] - (k >= 2 ? 0 : 1), at[axis]};
    }
    const auto squared_length = [&](std::size_t a, std::size_t b) {
      const double x = seen[a].x - seen[b].x, y = seen[a].y - seen[b].y;
      const double height = seen[a].height - seen[b].height;
      return x * x + y * y + height * height;
    };
    const bool first_is_shorter = squared_length(0, 2) <= squared_length(1, 3);
    const auto is_good = [&seen](bool from_first) {
      return from_first ? IsInEnvelope({seen[0], seen[2], seen[1], seen[3]}, kEnvelopeMargin)
                        : IsInEnvelope({seen[1], seen[3], seen[2], seen[0]}, kEnvelopeMargin);
    };
    return is_good(first_is_shorter) || !is_good(!first_is_shorter) ? first_is_shorter
                                                                    : !first_is_shorter;
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
    RunInArena(execution,
               [&] { result = KeepLargestShell(Extraction(band, target).Run(), band.voxel_size); });
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

#include "volume/lattice_quads.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "volume/diagonals.h"
#include "volume/envelope.h"

namespace lascaux {
namespace {

// In units of the lattice. Places in cells and what is computed of them are numbers below 4: in
// single precision they are off by less than a tenth of the margin. In double precision places are
// off by less than a hundredth of it, as far out as cells have numbers.
constexpr float kMargin = 1e-5F;
constexpr double kFineMargin = 1e-8;

using Triangle = std::array<std::uint32_t, 3>;

/// Corners d0, d1, a, b of triangles (d0, d1, a) and (d1, d0, b).
std::optional<std::array<std::uint32_t, 4>> Join(const Triangle& s, const Triangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t d0 = s[i], d1 = s[(i + 1) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] == d1 && t[(k + 1) % 3] == d0) return {{d0, d1, s[(i + 2) % 3], t[(k + 2) % 3]}};
    }
  }
  return std::nullopt;
}

LASCAUX_INLINE FourInts AsInts(const Four& bits) {
  FourInts ints;
  std::memcpy(&ints, &bits, sizeof ints);
  return ints;
}

/// The first of three where one mask holds, the second where the other does, the third elsewhere.
template <typename T>
LASCAUX_INLINE T Pick(const std::array<FourInts, 2>& masks, const T& a, const T& b, const T& c) {
  return masks[0] ? a : masks[1] ? b : c;
}

}  // namespace

LatticeQuads::LatticeQuads(const Mesh& mesh, const LatticeCells& cells)
    : mesh_(mesh), cells_(cells) {
  per_unit_.fill(cells.PerUnit());
  for (std::size_t axis = 0; axis < 3; ++axis)
    shift_[axis].fill(cells.Shift()[static_cast<Eigen::Index>(axis)]);
}

void LatticeQuads::Look(std::size_t first, std::size_t count) {
  std::array<std::size_t, 4> quads;
  for (std::size_t i = 0; i < 4; ++i) quads[i] = first + std::min(i, count - 1);
  JoinHalves(quads);
  PlaceCorners();
  FindEdges();
}

void LatticeQuads::JoinHalves(const std::array<std::size_t, 4>& quads) {
  const auto four = [&](std::size_t i, std::size_t from) {
    return reinterpret_cast<const float*>(mesh_.triangles.data() + 2 * quads[i]) + from;
  };
  const auto two_columns = [&](std::size_t from) {
    const Four low = TwoAndTwo(four(0, from), four(1, from));
    const Four high = TwoAndTwo(four(2, from), four(3, from));
    return std::array<FourInts, 2>{AsInts(__builtin_shufflevector(low, high, 0, 2, 4, 6)),
                                   AsInts(__builtin_shufflevector(low, high, 1, 3, 5, 7))};
  };
  const auto [s0, s1] = two_columns(0);
  const auto [s2, t0] = two_columns(2);
  const auto [t1, t2] = two_columns(4);
  // As ExtractMesh cuts them, or in any other way.
  const FourInts from_first = (t0 == s0) & (t1 == s2);
  vertex_ = {from_first ? s2 : s1, from_first ? s0 : s2, from_first ? s1 : s0,
             from_first ? t2 : t1};
  is_whole_ = from_first | ((t0 == s1) & (t2 == s2));
  if (AreAll(is_whole_)) return;
  for (std::size_t i = 0; i < 4; ++i) {
    if (is_whole_[i] != 0) continue;
    const auto joined = Join(mesh_.triangles[2 * quads[i]], mesh_.triangles[2 * quads[i] + 1]);
    if (!joined) continue;
    is_whole_[i] = -1;
    for (std::size_t k = 0; k < 4; ++k) vertex_[k][i] = static_cast<std::int32_t>((*joined)[k]);
  }
}

void LatticeQuads::PlaceCorners() {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto at = [&](std::size_t i) { return mesh_.vertices[Vertex(i, k)].data(); };
    const FourPoints points = Gather<const float>({at(0), at(1), at(2), at(3)});
    const std::array<const Four*, 3> along = {&points.x, &points.y, &points.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      FourDoubles per_unit, shift;
      std::memcpy(&per_unit, per_unit_.data(), sizeof per_unit);
      std::memcpy(&shift, shift_[axis].data(), sizeof shift);
      const FourDoubles in_cells =
          __builtin_convertvector(*along[axis], FourDoubles) * per_unit + shift;
      const FourInts cell = __builtin_convertvector(in_cells, FourInts);
      const Four in_cell =
          __builtin_convertvector(in_cells - __builtin_convertvector(cell, FourDoubles), Four);
      cell_[k][axis] = cell;
      at_[k][axis] = in_cell;
      is_whole_ &= (in_cell > kMargin) & (in_cell < 1 - kMargin);
    }
  }
}

void LatticeQuads::FindEdges() {
  // Opposite cells are one apart along all axes but that of the edge.
  std::array<FourInts, 3> is_same;
  FourInts are_near = is_whole_;
  for (std::size_t along = 0; along < 3; ++along) {
    const FourInts apart = cell_[1][along] - cell_[0][along];
    is_same[along] = apart == 0;
    are_near &= (apart <= 1) & (apart >= -1);
  }
  is_around_ = are_near & (is_same[0] + is_same[1] + is_same[2] == -1);
  const std::array<FourInts, 2> masks = {is_same[0], is_same[1]};
  axis_ = (is_same[1] & 1) | (is_same[2] & 2);
  std::array<FourInts, 4> u, w;
  std::array<SeenCorners, 4> seen;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [x, y, z] = cell_[k];
    u[k] = Pick(masks, y, z, x);
    w[k] = Pick(masks, z, x, y);
    is_around_ &= Pick(masks, x, y, z) == Pick(masks, cell_[0][0], cell_[0][1], cell_[0][2]);
  }
  const FourInts low_u = u[0] < u[1] ? u[0] : u[1], low_w = w[0] < w[1] ? w[0] : w[1];
  for (std::size_t k = 0; k < 4; ++k) {
    const FourInts beyond_u = u[k] - low_u, beyond_w = w[k] - low_w;
    is_around_ &= ((beyond_u | beyond_w) & ~1) == 0;
    quadrant_[k] = beyond_u + 2 * beyond_w;
    edge_[k] = 4 * axis_ + 3 - quadrant_[k];
    // The edge is where the lower cell ends.
    const auto& [x, y, z] = at_[k];
    seen[k] = {Pick(masks, y, z, x) + __builtin_convertvector(beyond_u - 1, Four),
               Pick(masks, z, x, y) + __builtin_convertvector(beyond_w - 1, Four),
               Pick(masks, x, y, z)};
  }
  // One in each quadrant: d0 and d1 are in opposite ones.
  is_around_ &= (quadrant_[2] + quadrant_[3] == 3) & (quadrant_[2] != quadrant_[0]) &
                (quadrant_[2] != quadrant_[1]);
  // From d0 to d1 and a counter-clockwise, seen from where the axis points to?
  const FourInts is_beyond_both = (quadrant_[0] == 0) | (quadrant_[0] == 3);
  const FourInts a_is_beyond_w = ((quadrant_[2] ^ quadrant_[0]) & 1) == 0;
  starts_inside_ = is_beyond_both == a_is_beyond_w;
  in_envelope_ = AreInEnvelope(seen, kMargin);
  // Where the surface is flat, diagonals often run straight through their edges.
  if (AreAll(in_envelope_ | ~is_around_)) return;
  for (std::size_t i = 0; i < 4; ++i) {
    if (in_envelope_[i] == 0 && IsAroundEdge(i)) in_envelope_[i] = IsFinelyInEnvelope(i) ? -1 : 0;
  }
}

bool LatticeQuads::IsFinelyInEnvelope(std::size_t i) const {
  const int axis = axis_[i], u = (axis + 1) % 3, w = (axis + 2) % 3;
  std::array<SeenCorner, 4> seen;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3f& p = mesh_.vertices[Vertex(i, k)];
    const auto in_cell = [&](int along) {
      return cells_.InCells(p[along], along) - cell_[k][static_cast<std::size_t>(along)][i];
    };
    seen[k] = {in_cell(u) + (quadrant_[k][i] & 1) - 1, in_cell(w) + (quadrant_[k][i] >> 1) - 1,
               in_cell(axis)};
  }
  return lascaux::IsInEnvelope(seen, kFineMargin);
}

}  // namespace lascaux

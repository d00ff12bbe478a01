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

/// Along which axis two opposite cells around an edge are not apart, from how far apart they are
/// along each: 9 (x + 1) + 3 (y + 1) + z + 1.
constexpr std::array<std::uint8_t, 27> kAxes = [] {
  std::array<std::uint8_t, 27> axes{};
  for (int i = 0; i < 27; ++i) {
    const std::array<int, 3> apart = {i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1};
    axes[static_cast<std::size_t>(i)] = 3;
    if (std::count(apart.begin(), apart.end(), 0) != 1) continue;
    axes[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::find(apart.begin(), apart.end(), 0) - apart.begin());
  }
  return axes;
}();

}  // namespace

void LatticeQuads::Look(std::size_t first, std::size_t count) {
  JoinHalves(first, count);
  PlaceCorners(count);
  for (std::size_t i = 0; i < count; ++i) FindEdge(i);
  FindInEnvelope(count);
  // Where the surface is flat, diagonals often run straight through their edges.
  for (std::size_t i = 0; i < count; ++i)
    if (in_envelope_[i] == 0 && IsAroundEdge(i)) in_envelope_[i] = IsFinelyInEnvelope(i) ? 1 : 0;
}

void LatticeQuads::JoinHalves(std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle& s = mesh_.triangles[2 * (first + i)];
    const Triangle& t = mesh_.triangles[2 * (first + i) + 1];
    // As ExtractMesh cuts them, or in any other way.
    std::array<std::uint32_t, 4> corners = {s[0], s[2], s[1], t[2]};
    is_whole_[i] = 1;
    if (t[0] == s[0] && t[1] == s[2]) {
      corners = {s[2], s[0], s[1], t[2]};
    } else if (t[0] == s[1] && t[2] == s[2]) {
      corners = {s[1], s[2], s[0], t[1]};
    } else if (const auto joined = Join(s, t)) {
      corners = *joined;
    } else {
      is_whole_[i] = 0;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3f& p = mesh_.vertices[corners[k]];
      vertex_[k][i] = corners[k];
      for (std::size_t axis = 0; axis < 3; ++axis) at_[k][axis][i] = p[static_cast<int>(axis)];
    }
  }
}

void LatticeQuads::PlaceCorners(std::size_t count) {
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float* const at = at_[k][axis].data();
      std::int32_t* const cell = cell_[k][axis].data();
      for (std::size_t i = 0; i < count; ++i) {
        const double in_cells = cells_.InCells(at[i], static_cast<int>(axis));
        cell[i] = static_cast<std::int32_t>(in_cells);
        at[i] = static_cast<float>(in_cells - cell[i]);
      }
      for (std::size_t i = 0; i < count; ++i)
        is_whole_[i] &= (at[i] > kMargin ? 1 : 0) & (at[i] < 1 - kMargin ? 1 : 0);
    }
  }
}

void LatticeQuads::FindInEnvelope(std::size_t count) {
  for (std::size_t i = 0; i < count; i += 4) {
    std::array<SeenCorners, 4> q;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto load = [i](const std::array<float, kMost>& from) {
        Four four;
        std::memcpy(&four, from.data() + i, sizeof four);
        return four;
      };
      q[k] = {load(seen_[k].x), load(seen_[k].y), load(seen_[k].height)};
    }
    const FourInts are = AreInEnvelope(q, kMargin);
    for (std::size_t j = 0; j < 4; ++j) in_envelope_[i + j] = are[j] != 0 ? 1 : 0;
  }
}

bool LatticeQuads::IsFinelyInEnvelope(std::size_t i) const {
  const int axis = axis_[i], u = (axis + 1) % 3, w = (axis + 2) % 3;
  std::array<SeenCorner, 4> seen;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3f& p = mesh_.vertices[vertex_[k][i]];
    const auto in_cell = [&](int along) {
      return cells_.InCells(p[along], along) - cell_[k][static_cast<std::size_t>(along)][i];
    };
    seen[k] = {in_cell(u) + (quadrant_[k][i] & 1) - 1, in_cell(w) + (quadrant_[k][i] >> 1) - 1,
               in_cell(axis)};
  }
  return lascaux::IsInEnvelope(seen, kFineMargin);
}

void LatticeQuads::FindEdge(std::size_t i) {
  axis_[i] = kNone;
  const auto cell = [&](std::size_t k, std::size_t along) { return cell_[k][along][i]; };
  std::array<std::int32_t, 3> apart;
  for (std::size_t along = 0; along < 3; ++along)
    apart[along] = cell(1, along) - cell(0, along) + 1;
  if (is_whole_[i] == 0 || ((apart[0] | apart[1] | apart[2]) & ~3) != 0) return;
  if (apart[0] == 3 || apart[1] == 3 || apart[2] == 3) return;
  const std::uint8_t axis = kAxes[static_cast<std::size_t>(9 * apart[0] + 3 * apart[1] + apart[2])];
  if (axis == kNone) return;
  const std::size_t u = (axis + 1U) % 3, w = (axis + 2U) % 3;
  const std::int32_t low_u = std::min(cell(0, u), cell(1, u));
  const std::int32_t low_w = std::min(cell(0, w), cell(1, w));
  unsigned all = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::int32_t beyond_u = cell(k, u) - low_u, beyond_w = cell(k, w) - low_w;
    if (((beyond_u | beyond_w) & ~1) != 0 || cell(k, axis) != cell(0, axis)) return;
    quadrant_[k][i] = static_cast<std::uint8_t>(beyond_u + 2 * beyond_w);
    all |= 1U << quadrant_[k][i];
    // The edge is where the lower cell ends.
    seen_[k].x[i] = at_[k][u][i] + static_cast<float>(beyond_u - 1);
    seen_[k].y[i] = at_[k][w][i] + static_cast<float>(beyond_w - 1);
    seen_[k].height[i] = at_[k][axis][i];
  }
  if (all != 0xF) return;
  axis_[i] = axis;
  // From d0 to d1 and a counter-clockwise, seen from where the axis points to?
  const auto beyond_u = [&](std::size_t k) { return quadrant_[k][i] & 1; };
  const auto beyond_w = [&](std::size_t k) { return quadrant_[k][i] >> 1; };
  const int turn = (beyond_u(1) - beyond_u(0)) * (beyond_w(2) - beyond_w(0)) -
                   (beyond_w(1) - beyond_w(0)) * (beyond_u(2) - beyond_u(0));
  starts_inside_[i] = turn > 0 ? 1 : 0;
}

}  // namespace lascaux

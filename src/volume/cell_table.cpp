#include "volume/cell_table.h"

namespace lascaux {
namespace {

/// A corner of a face, going round it; `axis` is across the face.
constexpr std::array<std::array<int, 2>, 4> kRound = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

constexpr int Corner(int axis, int along, int u, int w) {
  return along << axis | u << (axis + 1) % 3 | w << (axis + 2) % 3;
}

/// The edge between corners k and k + 1 of a face.
constexpr std::size_t FaceEdge(int axis, int side, std::size_t k) {
  const auto [u, w] = kRound[k];
  const auto [next_u, next_w] = kRound[(k + 1) % 4];
  // Along u, the places across are w and the face's axis; along w, the axis and u.
  if (u != next_u) return CellEdge((axis + 1) % 3, w, side);
  return CellEdge((axis + 2) % 3, side, u);
}

/// Edges of a cell in sets, joined one by one.
struct EdgeSets {
  std::array<std::size_t, kCellEdges> root{};

  constexpr EdgeSets() {
    for (std::size_t i = 0; i < kCellEdges; ++i) root[i] = i;
  }
  constexpr void Join(std::size_t a, std::size_t b) {
    const std::size_t from = root[a], to = root[b];
    for (std::size_t& r : root) {
      if (r == from) r = to;
    }
  }
};

constexpr CellPieces Divide(int signs, bool apart) {
  const auto is_inside = [signs](int corner) { return (signs >> corner & 1) != 0; };
  EdgeSets sets;
  std::array<bool, kCellEdges> crossed{};
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, side = face % 2;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto corner = [&](std::size_t i) {
        return is_inside(Corner(axis, side, kRound[i % 4][0], kRound[i % 4][1]));
      };
      if (corner(k) != corner(k + 1)) crossed[FaceEdge(axis, side, k)] = true;
      // A line around the corner at k, by its own if the two beside it are on the other side.
      if (corner(k) == corner(k + 1) || corner(k) == corner(k + 3)) continue;
      const bool is_alone = corner(k + 2) != corner(k);
      if (is_alone || corner(k) == apart)
        sets.Join(FaceEdge(axis, side, k), FaceEdge(axis, side, (k + 3) % 4));
    }
    // Two corners of each side beside each other: the line runs across.
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t a = FaceEdge(axis, side, k), b = FaceEdge(axis, side, k + 2);
      const auto corner = [&](std::size_t i) {
        return is_inside(Corner(axis, side, kRound[i % 4][0], kRound[i % 4][1]));
      };
      if (corner(k) != corner(k + 1) && corner(k + 1) == corner(k + 2) &&
          corner(k) == corner(k + 3))
        sets.Join(a, b);
    }
  }
  CellPieces pieces;
  std::array<std::uint8_t, kCellEdges> number{};
  number.fill(kNotCrossed);
  for (std::size_t e = 0; e < kCellEdges; ++e) {
    pieces.of_edge[e] = kNotCrossed;
    if (!crossed[e]) continue;
    std::uint8_t& n = number[sets.root[e]];
    if (n == kNotCrossed) n = pieces.count++;
    pieces.of_edge[e] = n;
  }
  for (int face = 0; face < 6; ++face) {
    bool is_twice = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint8_t piece = pieces.of_edge[FaceEdge(face / 2, face % 2, k)];
      is_twice = is_twice && piece != kNotCrossed &&
                 piece == pieces.of_edge[FaceEdge(face / 2, face % 2, 0)];
    }
    if (is_twice) pieces.twice = static_cast<std::uint8_t>(face);
  }
  return pieces;
}

constexpr CellTable MakeTable(bool apart) {
  CellTable table;
  for (int signs = 0; signs < 256; ++signs)
    table[static_cast<std::size_t>(signs)] = Divide(signs, apart);
  return table;
}

}  // namespace

constinit const CellTable kPiecesJoined = MakeTable(false);
constinit const CellTable kPiecesApart = MakeTable(true);

}  // namespace lascaux

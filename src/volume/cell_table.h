#pragma once

#include <array>
#include <cstdint>

namespace lascaux {

/// A cell's corners as bits, set inside: bit x + 2 y + 4 z.
using CellSigns = std::uint8_t;

inline constexpr std::size_t kCellEdges = 12;
inline constexpr std::uint8_t kNotCrossed = 0xFF;
inline constexpr std::uint8_t kNoFace = 0xFF;

/// Edge of a cell along `axis` whose place across it is (u, w), along the next two axes.
constexpr std::size_t CellEdge(int axis, int u, int w) {
  return static_cast<std::size_t>(4 * axis + u + 2 * w);
}

/// How the surface runs through a cell.
struct CellPieces {
  std::uint8_t count = 0;                             ///< of pieces
  std::array<std::uint8_t, kCellEdges> of_edge = {};  ///< piece that crosses it, or kNotCrossed
  /// A face (2 axis + side) that one piece crosses twice, or kNoFace. There is at most one, and
  /// no other face with four crossings then.
  std::uint8_t twice = kNoFace;
};

/// For each number of corners' signs.
using CellTable = std::array<CellPieces, 256>;
extern const CellTable kPiecesJoined, kPiecesApart;

/// Where inside corners are across from each other on a face, the surface runs around both: thin
/// parts hold together.
inline const CellPieces& PiecesJoined(CellSigns signs) { return kPiecesJoined[signs]; }

/// The opposite: it runs between them. Where two cells with one face `twice` between them take this
/// one, no edge of the mesh has four faces.
inline const CellPieces& PiecesApart(CellSigns signs) { return kPiecesApart[signs]; }

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/mesh.h"
#include "volume/cell_table.h"

/// @file
/// The quadrilaterals of a dual mesh, as the lattice sees them.

namespace lascaux {

/// A cell's key: its block of 8 x 8 x 8, then the cell in there, 64 x + 8 y + z.
inline constexpr int kBitsInBlock = 9;
inline constexpr std::uint64_t kNoCell = ~std::uint64_t{0} >> 1;

/// Where points are in a lattice. Its cells have numbers from 0 to 2^21, so that they are never
/// negative.
class LatticeCells {
 public:
  explicit LatticeCells(const Lattice& lattice)
      : per_unit_(1 / lattice.size),
        shift_(static_cast<double>(kMiddle) - lattice.origin.array() / lattice.size) {}

  /// Off by 1e-10 cells at most.
  double InCells(float at, int axis) const {
    return static_cast<double>(at) * per_unit_ + shift_[axis];
  }

  /// Precondition: KeyOf() it is not kNoCell.
  Eigen::Array3i CellOf(const Eigen::Vector3f& p) const {
    return {static_cast<int>(InCells(p.x(), 0)), static_cast<int>(InCells(p.y(), 1)),
            static_cast<int>(InCells(p.z(), 2))};
  }

  /// kNoCell for a point that is too far out.
  std::uint64_t KeyOf(const Eigen::Vector3f& p) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double at = InCells(p[axis], axis);
      if (!(at >= kMiddle - kFarthest && at <= kMiddle + kFarthest)) return kNoCell;
    }
    const Eigen::Array3i cell = CellOf(p);
    return Key(cell.x(), cell.y(), cell.z());
  }

  static std::uint64_t Key(int x, int y, int z) {
    const auto block = [](int i) { return static_cast<std::uint64_t>(i >> 3); };
    const auto place = [](int i) { return static_cast<std::uint64_t>(i & 7); };
    return block(x) << (36 + kBitsInBlock) | block(y) << (18 + kBitsInBlock) |
           block(z) << kBitsInBlock | place(x) << 6 | place(y) << 3 | place(z);
  }

 private:
  static constexpr int kMiddle = 1 << 20, kFarthest = 1'000'000;

  double per_unit_;
  Eigen::Array3d shift_;
};

/// Up to so many pairs of consecutive triangles, each as a quadrilateral d0 b d1 a that is cut from
/// d0 to d1.
class LatticeQuads {
 public:
  static constexpr std::size_t kMost = 64;

  LatticeQuads(const Mesh& mesh, const LatticeCells& cells) : mesh_(mesh), cells_(cells) {}

  /// Looks at those from triangle 2 `first` on.
  void Look(std::size_t first, std::size_t count);

  /// Is the `i`th of them a quadrilateral with one corner in each cell around an edge, strictly
  /// inside, d0 opposite to d1? Only then have the others a meaning.
  bool IsAroundEdge(std::size_t i) const { return axis_[i] != kNone; }

  /// In the order d0, d1, a, b.
  std::array<std::uint32_t, 4> Vertices(std::size_t i) const {
    return {vertex_[0][i], vertex_[1][i], vertex_[2][i], vertex_[3][i]};
  }

  /// The edge's number (CellEdge) in the cell of corner `k`.
  std::size_t EdgeOf(std::size_t i, std::size_t k) const {
    return 4 * std::size_t{axis_[i]} + 3 - quadrant_[k][i];
  }

  /// Is it turned as around an edge that starts inside?
  bool StartsInside(std::size_t i) const { return starts_inside_[i] != 0; }

  /// Is it in its edge's envelope (envelope.h), whatever rounding loses?
  bool IsInEnvelope(std::size_t i) const { return in_envelope_[i] != 0; }

 private:
  static constexpr std::uint8_t kNone = 3;  // for an axis

  void JoinHalves(std::size_t first, std::size_t count);
  void PlaceCorners(std::size_t count);
  void FindEdge(std::size_t i);
  void FindInEnvelope(std::size_t count);
  bool IsFinelyInEnvelope(std::size_t i) const;

  const Mesh& mesh_;
  const LatticeCells& cells_;
  std::array<std::array<std::uint32_t, kMost>, 4> vertex_;
  // By corners and axes.
  std::array<std::array<std::array<std::int32_t, kMost>, 3>, 4> cell_;
  std::array<std::array<std::array<float, kMost>, 3>, 4> at_;
  std::array<std::int32_t, kMost> is_whole_;  // joined, and strictly inside of cells
  std::array<std::uint8_t, kMost> axis_, starts_inside_, in_envelope_;
  std::array<std::array<std::uint8_t, kMost>, 4> quadrant_;  // 1 beyond along u, 2 along w
  /// Corners as seen along their edges.
  struct Seen {
    alignas(16) std::array<float, kMost> x, y, height;
  };
  std::array<Seen, 4> seen_;
};

}  // namespace lascaux

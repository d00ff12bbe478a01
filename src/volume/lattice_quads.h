#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/mesh.h"
#include "volume/cell_table.h"
#include "volume/four.h"

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

  /// What that multiplies with, and adds then.
  double PerUnit() const { return per_unit_; }
  const Eigen::Array3d& Shift() const { return shift_; }

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

/// Four pairs of consecutive triangles, each as a quadrilateral d0 b d1 a that is cut from d0 to
/// d1.
class LatticeQuads {
 public:
  static constexpr std::size_t kMost = 4;

  LatticeQuads(const Mesh& mesh, const LatticeCells& cells);

  /// Looks at up to four from triangle 2 `first` on; what is asked of others has no meaning.
  void Look(std::size_t first, std::size_t count);

  /// Is the `i`th of them a quadrilateral with one corner in each cell around an edge, strictly
  /// inside, d0 opposite to d1? Only then have the others a meaning.
  bool IsAroundEdge(std::size_t i) const { return is_around_[i] != 0; }

  /// Corner `k` in the order d0, d1, a, b.
  std::uint32_t Vertex(std::size_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(vertex_[k][i]);
  }

  /// The edge's number (CellEdge) in the cell of corner `k`.
  std::size_t EdgeOf(std::size_t i, std::size_t k) const {
    return static_cast<std::size_t>(edge_[k][i]);
  }

  /// Is it turned as around an edge that starts inside?
  bool StartsInside(std::size_t i) const { return starts_inside_[i] != 0; }

  /// Is it in its edge's envelope (envelope.h), whatever rounding loses?
  bool IsInEnvelope(std::size_t i) const { return in_envelope_[i] != 0; }

 private:
  void JoinHalves(const std::array<std::size_t, 4>& quads);
  void PlaceCorners();
  void FindEdges();
  bool IsFinelyInEnvelope(std::size_t i) const;

  const Mesh& mesh_;
  const LatticeCells& cells_;
  std::array<double, 4> per_unit_;              // LatticeCells', four times
  std::array<std::array<double, 4>, 3> shift_;  // by axes
  // By corners, and by axes.
  std::array<FourInts, 4> vertex_;
  std::array<std::array<FourInts, 3>, 4> cell_;
  std::array<std::array<Four, 3>, 4> at_;
  FourInts is_whole_;  // joined, and strictly inside of cells
  FourInts is_around_, starts_inside_, in_envelope_;
  FourInts axis_;
  std::array<FourInts, 4> edge_, quadrant_;  // 1 beyond along u, 2 along w
};

}  // namespace lascaux

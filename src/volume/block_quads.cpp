#include "volume/block_quads.h"

#include <bit>
#include <cstring>
#include <utility>

#include "volume/block_vertices.h"
#include "volume/diagonals.h"
#include "volume/sign_planes.h"

namespace lascaux {
namespace {

// By how much of a voxel a quadrilateral stays within reach of its edge before its vertices are
// rounded to their places in the model.
constexpr float kEnvelopeMargin = 1e-3F;

/// Edges along one axis, each in one number: the place of the cell whose upper corner it ends in
/// (BlockVertices), the number of its quadrilateral in the block, and the sign bit where it starts
/// inside.
class Edges {
 public:
  void Add(std::size_t place, std::size_t quad, bool starts_inside) {
    edges_[count_++] = static_cast<std::int32_t>(static_cast<std::uint32_t>(starts_inside) << 31 |
                                                 quad << kPlaceBits | place);
  }

  /// Calls visit(places, quads, masks of those that start inside) for four at a time; the last one
  /// fills up.
  template <typename Visit>
  void ForFours(Visit&& visit) {
    if (count_ == 0) return;
    for (std::size_t i = count_; i < count_ + 3; ++i) edges_[i] = edges_[count_ - 1];
    for (std::size_t at = 0; at < count_; at += 4) {
      FourInts four;
      std::memcpy(&four, edges_.data() + at, sizeof four);
      visit(four & ((1 << kPlaceBits) - 1), (four & kLargest) >> kPlaceBits, four >> 31);
    }
  }

 private:
  static constexpr int kPlaceBits = 10;
  static constexpr std::int32_t kLargest = 0x7FFFFFFF;
  std::array<std::int32_t, kBlockVoxels + 3> edges_;
  std::size_t count_ = 0;
};

class Connection {
 public:
  Connection(const SurfaceCells& cells, std::size_t block, const QuadTarget& target)
      : cells_(cells), block_(block), target_(target), around_(cells, block) {}

  VertexPairs Run() {
    std::size_t quad = 0;
    ForLayers(cells_, block_, [&](std::size_t x, const SignPlanes& low, const SignPlanes& high) {
      const std::array<UpperEdges, 3> edges = UpperEdgesOf(low, high);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::uint64_t word = edges[axis].crossed; word != 0; word &= word - 1) {
          const auto i = static_cast<std::size_t>(std::countr_zero(word));
          edges_[axis].Add(BlockVertices::PlaceOf(64 * x + i), quad++,
                           (edges[axis].starts_inside >> i & 1) != 0);
        }
      }
    });
    Connect<0>();
    Connect<1>();
    Connect<2>();
    return std::move(pairs_);
  }

 private:
  /// Vertices, by corners of four quadrilaterals.
  using Corners = std::array<std::array<std::uint32_t, 4>, 4>;

  template <int kAxis>
  void Connect() {
    // From the cell itself counter-clockwise, seen from where the axis points to.
    constexpr std::size_t kU = BlockVertices::kStride[(kAxis + 1) % 3];
    constexpr std::size_t kW = BlockVertices::kStride[(kAxis + 2) % 3];
    constexpr std::array<std::size_t, 4> kSteps = {0, kU, kU + kW, kW};
    edges_[kAxis].ForFours(
        [&](const FourInts& places, const FourInts& quads, const FourInts& start_inside) {
          Corners vertices;
          for (std::size_t k = 0; k < 4; ++k) {
            for (std::size_t i = 0; i < 4; ++i)
              vertices[k][i] = around_.At(static_cast<std::size_t>(places[i]) + kSteps[k]);
          }
          if (around_.HasSeveral()) TakePieces<kAxis>(places, kSteps, vertices);
          const std::array<SeenCorners, 4> seen = {
              See<kAxis, -1, -1>(vertices[0]), See<kAxis, 0, -1>(vertices[1]),
              See<kAxis, 0, 0>(vertices[2]), See<kAxis, -1, 0>(vertices[3])};
          Cut(vertices, AreCutFromFirst(seen, kEnvelopeMargin), start_inside, quads);
        });
  }

  /// Replaces kSeveral by the vertices of the pieces that cross the edges.
  template <int kAxis>
  void TakePieces(const FourInts& places, const std::array<std::size_t, 4>& steps,
                  Corners& vertices) {
    // The edge is the upper one of its cell, and the lower one of those beyond.
    constexpr std::array<std::size_t, 4> kEdges = {CellEdge(kAxis, 1, 1), CellEdge(kAxis, 0, 1),
                                                   CellEdge(kAxis, 0, 0), CellEdge(kAxis, 1, 0)};
    for (std::size_t i = 0; i < 4; ++i) {
      bool is_any_several = false;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t place = static_cast<std::size_t>(places[i]) + steps[k];
        is_any_several = is_any_several || around_.At(place) == BlockVertices::kSeveral;
        vertices[k][i] = around_.VertexAtEdge(place, kEdges[k]);
      }
      if (!is_any_several) continue;
      for (std::size_t k = 1; k < 4; ++k) pairs_.push_back({vertices[0][i], vertices[k][i]});
    }
  }

  template <int kAxis, int kX, int kY>
  SeenCorners See(const std::array<std::uint32_t, 4>& vertices) const {
    const auto at = [&](std::size_t i) { return target_.in_cell[vertices[i]].data(); };
    const FourPoints points = Gather<const float>({at(0), at(1), at(2), at(3)});
    const std::array<const Four*, 3> along = {&points.x, &points.y, &points.z};
    return {*along[(kAxis + 1) % 3] + static_cast<float>(kX),
            *along[(kAxis + 2) % 3] + static_cast<float>(kY), *along[kAxis]};
  }

  /// Writes two triangles for each of four, seen from outside.
  void Cut(const Corners& vertices, const FourInts& from_first, const FourInts& start_inside,
           const FourInts& quads) const {
    std::array<FourInts, 4> q;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto at = [&](std::size_t i) { return static_cast<std::int32_t>(vertices[k][i]); };
      q[k] = FourInts{at(0), at(1), at(2), at(3)};
    }
    // Either q0, next, last; next, q2, last or q0, next, q2; q0, q2, last.
    const FourInts next = start_inside ? q[1] : q[3], last = start_inside ? q[3] : q[1];
    const FourInts third = from_first ? q[2] : last, fourth = from_first ? q[0] : next;
    const std::array<FourInts, 2> front = Interleave(q[0], next),
                                  middle = Interleave(third, fourth), back = Interleave(q[2], last);
    for (std::size_t i = 0; i < 4; ++i) {
      const FourInts& a = front[i / 2];
      const FourInts& b = middle[i / 2];
      const FourInts four = i % 2 == 0 ? __builtin_shufflevector(a, b, 0, 1, 4, 5)
                                       : __builtin_shufflevector(a, b, 2, 3, 6, 7);
      auto* const to = reinterpret_cast<char*>(target_.triangles + 2 * quads[i]);
      std::memcpy(to, &four, sizeof four);
      std::memcpy(to + sizeof four, reinterpret_cast<const char*>(&back[i / 2]) + 8 * (i % 2), 8);
    }
  }

  static std::array<FourInts, 2> Interleave(const FourInts& a, const FourInts& b) {
    return {__builtin_shufflevector(a, b, 0, 4, 1, 5), __builtin_shufflevector(a, b, 2, 6, 3, 7)};
  }

  const SurfaceCells& cells_;
  std::size_t block_;
  QuadTarget target_;
  BlockVertices around_;
  std::array<Edges, 3> edges_;
  VertexPairs pairs_;
};

}  // namespace

VertexPairs ConnectAroundEdges(const SurfaceCells& cells, std::size_t block,
                               const QuadTarget& target) {
  return Connection(cells, block, target).Run();
}

}  // namespace lascaux

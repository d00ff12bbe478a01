#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compiled_data.h"

namespace lascaux {

/// The primitives that a block needs, seen from its origin: differences are taken in double
/// precision, so that what the vector code loses depends on the block's size and not on its place.
class Program {
 public:
  Program(const CompiledField::Data& data, const Eigen::Vector3d& origin, const ActiveSet& active);

  const internal::KernelProgram& kernel_program() const { return program_; }

  /// Least radius of what reaches the ball of radius `reach` around the origin, about, in the
  /// direction in which its part is thinnest.
  float ThinnestWithin(float reach) const;

 private:
  void BeginPart(const CompiledField::Data& data, std::uint32_t part,
                 const Eigen::Vector3d& origin);
  void Add(const CompiledPrimitive& primitive, const Eigen::Vector3d& origin);

  std::vector<internal::KernelSegment> segments_;
  std::vector<internal::KernelPoint> points_;
  std::vector<internal::KernelChain> chains_;
  std::vector<internal::KernelPart> parts_;
  std::vector<std::uint32_t> part_at_depth_;
  std::vector<internal::KernelMap> maps_;
  std::vector<float> steepness_;                           ///< of each part at the origin
  Eigen::Vector3d flat_origin_ = Eigen::Vector3d::Zero();  ///< of the part that was begun last
  internal::KernelProgram program_{};
};

/// Numbers of a tile, filled up with the last one to a multiple of the widest vector, so that every
/// number goes through the same code. Returns how many that are.
int LoadColumn(std::span<const float> from, float* to);

/// The points from `begin` on, as many as fit; returns how many.
int LoadTile(const PointBlock& block, std::size_t begin, internal::KernelPoints& tile);

/// Runs `kernel` over all tiles and hands each result with its place to `store`.
template <typename Kernel, typename Store>
void ForTiles(const CompiledField::Data& data, const PointBlock& points, const Program& program,
              Kernel kernel, Store store) {
  assert(points.y.size() == points.x.size() && points.z.size() == points.x.size());
  // Deep trees are rare; most need no memory from the heap.
  constexpr std::uint32_t kSlotsInPlace = 4;
  std::array<internal::KernelSamples, kSlotsInPlace> in_place;
  std::vector<internal::KernelSamples> on_heap(data.depths > kSlotsInPlace ? data.depths : 0);
  internal::KernelSamples* slots = on_heap.empty() ? in_place.data() : on_heap.data();
  internal::KernelPoints tile;
  internal::KernelSamples result;
  for (std::size_t begin = 0; begin < points.x.size(); begin += internal::kTile) {
    const int count = LoadTile(points, begin, tile);
    kernel(program.kernel_program(), tile, slots, &result);
    store(result, begin, count);
  }
}

}  // namespace lascaux

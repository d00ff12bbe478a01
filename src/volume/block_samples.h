#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "lascaux/field/compiled_field.h"
#include "volume/band.h"
#include "volume/find_blocks.h"

namespace lascaux {

/// Middle of a block's voxel centres, in the field's unit.
inline Eigen::Vector3d BlockCenter(const Block& block, double voxel_size) {
  const Eigen::Vector3d corner(block.origin.x(), block.origin.y(), block.origin.z());
  return voxel_size * (corner.array() + 0.5 * (kBlockSide - 1));
}

/// Offsets of a block's voxels from there.
struct BlockOffsets {
  std::array<float, kBlockVoxels> x, y, z;

  explicit BlockOffsets(double voxel_size) {
    const auto offset = [&](std::size_t k) {
      return static_cast<float>(voxel_size * (static_cast<double>(k) - 0.5 * (kBlockSide - 1)));
    };
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      x[i] = offset(i / 64);
      y[i] = offset(i / 8 % 8);
      z[i] = offset(i % 8);
    }
  }
};

/// Up to a block's worth of places with the field's samples there; lives on a thread's stack.
struct Samples {
  std::array<float, kBlockVoxels> x, y, z;
  std::array<float, kBlockVoxels> value, gradient_x, gradient_y, gradient_z, distance;

  /// Evaluates the field at the first n places: values, gradients and first-order distances, which
  /// are capped at `limit`.
  void Evaluate(const CompiledField& field, const Block& block, const Eigen::Vector3d& origin,
                std::size_t n, float limit) {
    const SampleBlock samples = {
        {value.data(), n}, {gradient_x.data(), n}, {gradient_y.data(), n}, {gradient_z.data(), n}};
    field.EvaluateSamples({origin, {x.data(), n}, {y.data(), n}, {z.data(), n}}, block.active,
                          samples);
    SignedDistances(samples, limit, {distance.data(), n}, field.isa());
  }

  Eigen::Vector3f Gradient(std::size_t i) const {
    return {gradient_x[i], gradient_y[i], gradient_z[i]};
  }
};

}  // namespace lascaux

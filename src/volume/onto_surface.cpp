#include "volume/onto_surface.h"

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "volume/four.h"

namespace lascaux {
namespace {

constexpr float kFarthest = 0.25F;  // voxels

/// Numbers of a block's points.
using Column = std::array<float, kBlockVoxels>;

}  // namespace

void BlockPoints::MoveOntoSurface(const CompiledField& field, const NarrowBand& band,
                                  std::size_t block) {
  if (count == 0) return;
  // The cells reach from the block's lowest voxel to the one behind its highest.
  constexpr float kHalf = 0.5F * kBlockSide;
  const auto h = static_cast<float>(band.voxel_size);
  const Eigen::Vector3d center =
      band.origin +
      band.voxel_size * (band.blocks[block].cast<double>().array() + double{kHalf}).matrix();
  Column from_x, from_y, from_z, distance, value, gradient_x, gradient_y, gradient_z;
  const std::size_t all = (count + 3) / 4 * 4;  // four at a time
  for (std::size_t i = 0; i < all; ++i) {
    from_x[i] = h * (x[i] - kHalf);
    from_y[i] = h * (y[i] - kHalf);
    from_z[i] = h * (z[i] - kHalf);
  }
  const auto first = [all](Column& column) { return std::span(column).first(all); };
  const Ball ball{center, 1.001 * std::sqrt(3.0) * double{kHalf} * band.voxel_size};
  const ActiveSet active = field.BoundOnBall(ball, field.All()).active;
  const SampleBlock samples{first(value), first(gradient_x), first(gradient_y), first(gradient_z)};
  field.EvaluateSamples({center, first(from_x), first(from_y), first(from_z)}, active, samples);
  SignedDistances(samples, h, first(distance), field.isa());
  for (std::size_t i = 0; i < all; i += 4) {
    const Four d = LoadFour(distance.data() + i), gx = LoadFour(gradient_x.data() + i),
               gy = LoadFour(gradient_y.data() + i), gz = LoadFour(gradient_z.data() + i);
    const Four squared = gx * gx + (gy * gy + gz * gz);
    const FourInts is_near = (Size(d) < kFarthest * h) & (squared > 0);
    // F falls outward, so the gradient points to the inside.
    const Four length = Root(squared), step = Where(is_near, d / h);
    const auto move = [&](const Four& gradient, Column& outward, Column& at) {
      const Four direction = Where(is_near, -(gradient / length));
      StoreFour(direction, outward.data() + i);
      StoreFour(LoadFour(at.data() + i) - step * direction, at.data() + i);
    };
    move(gx, outward_x, x);
    move(gy, outward_y, y);
    move(gz, outward_z, z);
  }
}

}  // namespace lascaux

#include "volume/onto_surface.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace lascaux {
namespace {

constexpr float kFarthest = 0.25F;  // voxels

}  // namespace

BlockPoints MoveOntoSurface(const CompiledField& field, const NarrowBand& band, std::size_t block,
                            std::vector<Eigen::Vector3f> places) {
  const std::size_t count = places.size();
  std::vector<Eigen::Vector3f> outward(count, Eigen::Vector3f::Zero());
  if (count == 0) return {};
  // The cells reach from the block's lowest voxel to the one behind its highest.
  constexpr float kHalf = 0.5F * kBlockSide;
  const auto h = static_cast<float>(band.voxel_size);
  const Eigen::Vector3d center =
      band.origin +
      band.voxel_size * (band.blocks[block].cast<double>().array() + double{kHalf}).matrix();
  std::vector<float> columns(8 * count);
  const auto column = [&](std::size_t k) { return std::span(columns).subspan(k * count, count); };
  const std::span<float> x = column(0), y = column(1), z = column(2), distance = column(3);
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = h * (places[i].x() - kHalf);
    y[i] = h * (places[i].y() - kHalf);
    z[i] = h * (places[i].z() - kHalf);
  }
  const Ball ball{center, 1.001 * std::sqrt(3.0) * double{kHalf} * band.voxel_size};
  const ActiveSet active = field.BoundOnBall(ball, field.All()).active;
  const SampleBlock samples{column(4), column(5), column(6), column(7)};
  field.EvaluateSamples({center, x, y, z}, active, samples);
  SignedDistances(samples, h, distance, field.isa());
  for (std::size_t i = 0; i < count; ++i) {
    if (!(std::abs(distance[i]) < kFarthest * h)) continue;
    // F falls outward, so the gradient points to the inside.
    const Eigen::Vector3f inward(samples.gradient_x[i], samples.gradient_y[i],
                                 samples.gradient_z[i]);
    outward[i] = -inward.normalized();
    places[i] -= distance[i] / h * outward[i];
  }
  return {std::move(places), std::move(outward)};
}

}  // namespace lascaux

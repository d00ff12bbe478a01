#include <algorithm>
#include <array>
#include <cassert>

#include "block_program.h"

namespace lascaux {

using internal::KernelSamples;
using internal::kTile;

void CompiledField::EvaluateValues(const PointBlock& points, const ActiveSet& active,
                                   std::span<float> values) const {
  assert(values.size() == points.x.size());
  const Program program(*data_, points.origin, active);
  ForTiles(*data_, points, program, data_->kernel->values,
           [&](const KernelSamples& result, std::size_t begin, int count) {
             std::copy_n(result.value, count, values.data() + begin);
           });
}

void CompiledField::EvaluateSamples(const PointBlock& points, const ActiveSet& active,
                                    const SampleBlock& samples) const {
  assert(samples.value.size() == points.x.size());
  const Program program(*data_, points.origin, active);
  ForTiles(*data_, points, program, data_->kernel->samples,
           [&](const KernelSamples& result, std::size_t begin, int count) {
             std::copy_n(result.value, count, samples.value.data() + begin);
             std::copy_n(result.x, count, samples.gradient_x.data() + begin);
             std::copy_n(result.y, count, samples.gradient_y.data() + begin);
             std::copy_n(result.z, count, samples.gradient_z.data() + begin);
           });
}

void SignedDistances(const SampleBlock& samples, float limit, std::span<float> distances, Isa isa) {
  const internal::BlockKernel& kernel = internal::KernelFor(isa);
  KernelSamples tile;
  std::array<float, kTile> result;
  for (std::size_t begin = 0; begin < distances.size(); begin += kTile) {
    const std::size_t count = std::min<std::size_t>(kTile, distances.size() - begin);
    LoadColumn(samples.value.subspan(begin, count), tile.value);
    LoadColumn(samples.gradient_x.subspan(begin, count), tile.x);
    LoadColumn(samples.gradient_y.subspan(begin, count), tile.y);
    tile.count = LoadColumn(samples.gradient_z.subspan(begin, count), tile.z);
    kernel.distances(tile, limit, result.data());
    std::copy_n(result.data(), count, distances.data() + begin);
  }
}

}  // namespace lascaux

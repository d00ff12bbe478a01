#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "volume/band.h"
#include "volume/band_view.h"
#include "volume/block_samples.h"

namespace lascaux {
namespace {

// The scheme errs by up to that much at radii of three voxels. Where the field says more, it speaks
// of another piece of the surface (in a crotch, beside a thin part), and the scheme is believed.
constexpr float kLargestCorrection = 0.35F;

/// Refines one block at a time; reads the band's distances and leaves them.
class BlockRefiner {
 public:
  BlockRefiner(const BandSource& source, const Band& band)
      : source_(source), band_(band), offsets_(source.voxel_size) {}

  void Run(std::size_t b, const VoxelMask& crossings, std::span<float> out) const {
    const BandView view(band_, band_.distance, b);
    const auto h = static_cast<float>(source_.voxel_size);
    std::array<std::uint16_t, kBlockVoxels> chosen;
    std::array<Eigen::Vector3f, kBlockVoxels> ways;  // to the surface
    Samples feet;
    std::size_t count = 0;
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      const float d = view.At(i);
      out[i] = d;
      if (d >= kSweepVoxels || (crossings[i / 64] >> i % 64 & 1) != 0) continue;
      const Eigen::Vector3f way = Descent(view, i);
      feet.x[count] = offsets_.x[i] + h * d * way.x();
      feet.y[count] = offsets_.y[i] + h * d * way.y();
      feet.z[count] = offsets_.z[i] + h * d * way.z();
      chosen[count] = static_cast<std::uint16_t>(i);
      ways[count++] = way;
    }
    if (count == 0) return;
    const Block& block = source_.blocks[b];
    feet.Evaluate(source_.field, block, BlockCenter(block, source_.voxel_size), count, kFar * h);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = chosen[k];
      const Eigen::Vector3f inward = feet.Gradient(k).normalized();
      // From the voxel to the plane that is tangent below the foot.
      const float outside = out[i] * ways[k].dot(inward) + feet.distance[k] / h;
      const float refined = view.IsInside(i) ? -outside : outside;
      if (std::abs(refined - out[i]) <= kLargestCorrection) out[i] = std::max(refined, 0.0F);
    }
  }

 private:
  /// Unit vector towards the surface, by the differences that the scheme itself took.
  static Eigen::Vector3f Descent(const BandView& view, std::size_t i) {
    Eigen::Vector3f way;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float low = view.Beside(i, 2 * axis), high = view.Beside(i, 2 * axis + 1);
      const float fall = std::max(view.At(i) - std::min(low, high), 0.0F);
      way[static_cast<int>(axis)] = low < high ? -fall : fall;
    }
    return way.normalized();
  }

  const BandSource& source_;
  const Band& band_;
  BlockOffsets offsets_;
};

}  // namespace

void RefineDistances(const BandSource& source, const std::vector<VoxelMask>& crossings, Band& band,
                     const Execution& execution) {
  VoxelFloats refined(band.distance.size());
  const BlockRefiner refiner(source, band);
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    if (execution.IsCancelled()) return;
    refiner.Run(b, crossings[b], std::span(refined).subspan(kBlockVoxels * b, kBlockVoxels));
  });
  band.distance = std::move(refined);
}

}  // namespace lascaux

#include "volume/render/coarse_field.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "volume/render/distance_transform.h"

namespace lascaux {
namespace {

/// Nodes around the surface's box: room for light to travel beside the model before it is clamped
/// to the box.
constexpr int kMargin = 3;

/// A node at most this far from the surface is a seed: no feature passes between nodes unseen (half
/// a cell's diagonal), as long as the band is that wide.
constexpr float kSeedStrides = 0.87F;

}  // namespace

CoarseField::CoarseField(const LeafTable& table, int nodes) {
  const Eigen::Vector3i extent = table.active_high - table.active_low + Eigen::Vector3i(1, 1, 1);
  const int longest = extent.maxCoeff();
  const int stride = std::max(1, (longest + nodes - 1) / nodes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size_[axis] = extent[static_cast<int>(axis)] / stride + 2 + 2 * kMargin;
  }
  const Eigen::Vector3i origin = table.active_low - Eigen::Vector3i::Constant(kMargin * stride);
  origin_ = origin.cast<float>();
  limit_ = (1 - 1e-6F) * Eigen::Vector3f(static_cast<float>(size_[0] - 1),
                                         static_cast<float>(size_[1] - 1),
                                         static_cast<float>(size_[2] - 1));
  stride_ = static_cast<float>(stride);
  inverse_stride_ = 1 / stride_;
  row_ = size_[0];
  slice_ = row_ * size_[1];
  const float band = table.background / table.voxel_size;
  // The lowest active voxel lies between the band's edge and one voxel above it.
  ground_ = static_cast<float>(table.active_low.y()) + band - 0.5F;
  Sample(table, origin, band);
}

void CoarseField::Sample(const LeafTable& table, const Eigen::Vector3i& origin, float band) {
  const std::size_t count = Index(size_[0] - 1, size_[1] - 1, size_[2] - 1) + 1;
  distance_.resize(count);
  NearestSeeds seeds{std::vector<float>(count, kNoSeed), std::vector<float>(count, 0.F)};
  const float seed_limit = std::min(kSeedStrides * stride_, 0.99F * band);
  const float per_voxel = 1 / table.voxel_size;
  const auto stride = static_cast<int>(stride_);
  tbb::parallel_for(tbb::blocked_range<int>(0, size_[2]), [&](const auto& slices) {
    for (int z = slices.begin(); z < slices.end(); ++z) {
      for (int y = 0; y < size_[1]; ++y) {
        for (int x = 0; x < size_[0]; ++x) {
          const float distance =
              per_voxel * table.ValueAt(origin + stride * Eigen::Vector3i(x, y, z));
          const std::size_t i = Index(x, y, z);
          distance_[i] = distance;
          if (distance > seed_limit) continue;
          seeds.squared_distance[i] = 0;
          seeds.value[i] = distance;
        }
      }
    }
  });
  seeds = SpreadSeeds(std::move(seeds), size_);
  const float edge = 0.99F * band;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (distance_[i] < edge) continue;
      const float estimate = stride_ * std::sqrt(seeds.squared_distance[i]) + seeds.value[i];
      distance_[i] = std::max(band, estimate);
    }
  });
}

std::vector<Eigen::Vector3f> CoarseField::SolidNodes() const {
  std::vector<Eigen::Vector3f> nodes;
  for (int z = 0; z < size_[2]; ++z) {
    for (int y = 0; y < size_[1]; ++y) {
      for (int x = 0; x < size_[0]; ++x) {
        if (distance_[Index(x, y, z)] > kSeedStrides * stride_) continue;
        nodes.push_back(origin_ + stride_ * Eigen::Vector3i(x, y, z).cast<float>());
      }
    }
  }
  return nodes;
}

}  // namespace lascaux

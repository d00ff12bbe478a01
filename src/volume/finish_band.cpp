#include "volume/finish_band.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace lascaux {
namespace {

using Eigen::Vector3i;

/// A block of the result: the swept block at its z and, for one below the plane, whose voxels are
/// one off, the block above that. One of the two may be missing.
struct Source {
  Vector3i origin;
  std::int32_t block, above;
  bool is_lower;
};

std::vector<Source> ListSources(const Band& band) {
  std::vector<Source> list;
  for (std::size_t b = 0; b < band.size(); ++b)
    list.push_back({band.origins[b], static_cast<std::int32_t>(b), kNoBlock, false});
  if (!band.upper_half) return list;
  for (std::size_t b = 0; b < band.size(); ++b) {
    const auto index = static_cast<std::int32_t>(b);
    const Vector3i& at = band.origins[b];
    const Vector3i image(at.x(), at.y(), -kBlockSide - at.z());
    list.push_back({image, index, band.neighbours[b][5], true});
    if (at.z() > 0 && band.neighbours[b][4] == kNoBlock)
      list.push_back({image + Vector3i(0, 0, kBlockSide), kNoBlock, index, true});
  }
  return list;
}

/// Where a block's values go.
struct Target {
  std::span<float> values;
  VoxelMask& active;
};

class Writer {
 public:
  Writer(const Band& band, double voxel_size)
      : band_(band),
        voxel_(static_cast<float>(voxel_size)),
        background_(BandBackground(voxel_size)) {}

  /// Does it hold a voxel of the band?
  bool HasBand(const Source& source) const {
    bool found = false;
    ForVoxels(source,
              [&](std::size_t, float distance, bool) { found = found || IsBand(distance); });
    return found;
  }

  /// On which side is its first voxel?
  bool IsInside(const Source& source) const {
    bool first = false;
    ForVoxels(source, [&](std::size_t i, float, bool inside) { first = i == 0 ? inside : first; });
    return first;
  }

  void Write(const Source& source, const Target& target) const {
    target.active = {};
    ForVoxels(source, [&](std::size_t i, float distance, bool is_inside) {
      const bool is_band = IsBand(distance);
      const float magnitude = is_band ? Scaled(distance) : background_;
      target.active[i / 64] |= static_cast<std::uint64_t>(is_band) << i % 64;
      target.values[i] = is_inside ? -magnitude : magnitude;
    });
  }

 private:
  float Scaled(float distance) const { return std::max(distance, kLeastDistance) * voxel_; }

  // Rounding must not take an active value to the background, or it would not be in the band.
  bool IsBand(float distance) const {
    return distance < static_cast<float>(kBandVoxels) && Scaled(distance) < background_;
  }

  bool IsInside(std::size_t block, std::size_t i) const {
    return (band_.inside[block][i / 64] >> i % 64 & 1) != 0;
  }

  /// Calls visit(voxel, distance, is inside) in order.
  template <typename Visit>
  void ForVoxels(const Source& source, Visit&& visit) const {
    const auto block = static_cast<std::size_t>(source.block);
    if (!source.is_lower) {
      const float* const distance = band_.distance.data() + kBlockVoxels * block;
      for (std::size_t i = 0; i < kBlockVoxels; ++i) visit(i, distance[i], IsInside(block, i));
      return;
    }
    for (std::size_t line = 0; line < kBlockVoxels; line += 8) {
      for (std::size_t k = 0; k < 8; ++k) {
        // Voxel k of the line is at -8 - z + k, the image of 8 - k above the block's lowest.
        const std::int32_t from = k == 0 ? source.above : source.block;
        const std::size_t at = line + (k == 0 ? 0 : 8 - k);
        if (from != kNoBlock) {
          const auto there = static_cast<std::size_t>(from);
          visit(line + k, band_.distance[kBlockVoxels * there + at], IsInside(there, at));
        } else {
          // Far from the surface, so on the same side as the voxel that touches it.
          const bool is_inside = k == 0 ? IsInside(block, line + 7)
                                        : IsInside(static_cast<std::size_t>(source.above), line);
          visit(line + k, kFar, is_inside);
        }
      }
    }
  }

  const Band& band_;
  float voxel_, background_;
};

}  // namespace

float BandBackground(double voxel_size) {
  const double least = kBandVoxels * voxel_size;
  auto background = static_cast<float>(least);
  while (static_cast<double>(background) < least) {
    background = std::nextafter(background, std::numeric_limits<float>::infinity());
  }
  return background;
}

NarrowBand FinishBand(const Band& band, const std::vector<Cube>& inside, double voxel_size) {
  const Writer writer(band, voxel_size);
  const std::vector<Source> sources = ListSources(band);
  std::vector<std::uint8_t> has_band(sources.size());
  tbb::parallel_for(std::size_t{0}, sources.size(),
                    [&](std::size_t i) { has_band[i] = writer.HasBand(sources[i]) ? 1 : 0; });

  NarrowBand result;
  result.voxel_size = voxel_size;
  result.background = BandBackground(voxel_size);
  for (const Cube& cube : inside) {
    result.inside.push_back(cube);
    if (!band.upper_half) continue;
    const Vector3i& at = cube.origin;
    result.inside.push_back({{at.x(), at.y(), -cube.side - at.z()}, cube.side});
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (has_band[i] != 0) {
      kept.push_back(i);
      result.blocks.push_back(sources[i].origin);
    } else if (writer.IsInside(sources[i])) {
      result.inside.push_back({sources[i].origin, kBlockSide});
    }
  }
  result.values.resize(kBlockVoxels * kept.size());
  result.active.resize(kept.size());
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t k) {
    const std::span values = std::span(result.values).subspan(kBlockVoxels * k, kBlockVoxels);
    writer.Write(sources[kept[k]], {values, result.active[k]});
  });
  return result;
}

}  // namespace lascaux

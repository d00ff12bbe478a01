#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "volume/band.h"

namespace lascaux {

/// A block with what lies around it: the six neighbours, the mirror plane, or nothing (far away).
class BandView {
 public:
  /// `values` holds kBlockVoxels for each block of the band; both must outlive the view.
  BandView(const Band& band, const VoxelFloats& values, std::size_t block)
      : mirrors_(band.upper_half && band.origins[block].z() == 0),
        own_(values.data() + kBlockVoxels * block),
        inside_(&band.inside[block]) {
    static const std::array<float, kBlockVoxels> kNothing = [] {
      std::array<float, kBlockVoxels> nothing;
      nothing.fill(kFar);
      return nothing;
    }();
    for (std::size_t side = 0; side < 6; ++side) {
      const std::int32_t n = band.neighbours[block][side];
      const auto index = static_cast<std::size_t>(n);
      beside_[side] = n == kNoBlock ? kNothing.data() : values.data() + kBlockVoxels * index;
      inside_beside_[side] = n == kNoBlock ? nullptr : &band.inside[index];
    }
  }

  /// Reads the block's own values from elsewhere, those around it from where they were.
  void SetOwn(const float* own) { own_ = own; }

  float At(std::size_t i) const { return own_[i]; }
  bool IsInside(std::size_t i) const { return ((*inside_)[i / 64] >> i % 64 & 1) != 0; }

  /// Value of the voxel beside voxel i at -x, +x, -y, +y, -z, +z.
  float Beside(std::size_t i, std::size_t side) const {
    const Place place = PlaceBeside(i, side);
    return (place.is_own ? own_ : beside_[side])[place.voxel];
  }

  /// Is that one inside? A missing one has no surface near, so it is where voxel i is.
  bool IsInsideBeside(std::size_t i, std::size_t side) const {
    const Place place = PlaceBeside(i, side);
    if (place.is_own) return IsInside(place.voxel);
    const VoxelMask* const mask = inside_beside_[side];
    return mask == nullptr ? IsInside(i) : ((*mask)[place.voxel / 64] >> place.voxel % 64 & 1) != 0;
  }

  /// The first voxels of a line of eight and of the lines beside it, for whole lines at a time.
  const float* Line(std::size_t at) const { return own_ + at; }
  std::array<const float*, 4> LinesBeside(std::size_t at) const {
    const std::size_t x = at / 64, y = at / 8 % 8;
    return {x > 0 ? own_ + at - 64 : beside_[0] + at + 7 * 64,
            x < 7 ? own_ + at + 64 : beside_[1] + at - 7 * 64,
            y > 0 ? own_ + at - 8 : beside_[2] + at + 7 * 8,
            y < 7 ? own_ + at + 8 : beside_[3] + at - 7 * 8};
  }
  float BeforeLine(std::size_t at) const { return mirrors_ ? own_[at + 1] : beside_[4][at + 7]; }
  float AfterLine(std::size_t at) const { return beside_[5][at]; }

 private:
  struct Place {
    bool is_own;
    std::size_t voxel;
  };

  Place PlaceBeside(std::size_t i, std::size_t side) const {
    constexpr std::array<std::size_t, 3> kStride = {64, 8, 1};
    const std::size_t stride = kStride[side / 2], k = i / stride % 8;
    if (side % 2 == 0) {
      if (k > 0) return {true, i - stride};
      if (side == 4 && mirrors_) return {true, i + 1};
      return {false, i + 7 * stride};
    }
    if (k < 7) return {true, i + stride};
    return {false, i - 7 * stride};
  }

  bool mirrors_;  // z = -1 is z = 1
  const float* own_;
  const VoxelMask* inside_;
  std::array<const float*, 6> beside_;
  std::array<const VoxelMask*, 6> inside_beside_;
};

}  // namespace lascaux

#pragma once

#include <array>

#include "volume/lanes.h"
#include "volume/render/coarse_field.h"

/// @file
/// Eight places at once, for the inner loops of rays.

namespace lascaux {

using LaneIndex [[gnu::vector_size(4 * kLanes)]] = std::int32_t;

/// Eight places or directions.
struct LanePoint {
  Lanes x, y, z;
};

/// Towards 0, of what fits into 32 bits.
LASCAUX_INLINE LaneIndex Truncated(const Lanes& a) { return __builtin_convertvector(a, LaneIndex); }
LASCAUX_INLINE Lanes AsFloats(const LaneIndex& a) { return __builtin_convertvector(a, Lanes); }

LASCAUX_INLINE Lanes Mix(const Lanes& a, const Lanes& b, const Lanes& t) { return a + t * (b - a); }

/// A value for each lane. Faster than to set them one after the other.
template <typename Value>
LASCAUX_INLINE Lanes Each(const Value& value) {
  return Lanes{value(0), value(1), value(2), value(3), value(4), value(5), value(6), value(7)};
}

/// `to` becomes `from` where the mask is set.
LASCAUX_INLINE void Take(const LaneMask& mask, const Lanes& from, Lanes& to) {
  to = mask ? from : to;
}

/// CoarseField::At of eight places, to the bit.
struct CoarseLanes {
  const CoarseField& coarse;

  LASCAUX_INLINE Lanes At(const LanePoint& p) const noexcept {
    const Lanes x = (p.x - coarse.origin_.x()) * coarse.inverse_stride_;
    const Lanes y = (p.y - coarse.origin_.y()) * coarse.inverse_stride_;
    const Lanes z = (p.z - coarse.origin_.z()) * coarse.inverse_stride_;
    const Lanes cx = Min(Max(x, Lanes{}), All(coarse.limit_.x()));
    const Lanes cy = Min(Max(y, Lanes{}), All(coarse.limit_.y()));
    const Lanes cz = Min(Max(z, Lanes{}), All(coarse.limit_.z()));
    const Lanes value = Trilinear(cx, cy, cz);
    const Lanes dx = x - cx, dy = y - cy, dz = z - cz;
    const Lanes beyond = dx * dx + dy * dy + dz * dz;
    return beyond == 0 ? value : Root(value * value + beyond * coarse.stride_ * coarse.stride_);
  }

 private:
  LASCAUX_INLINE Lanes Trilinear(const Lanes& px, const Lanes& py, const Lanes& pz) const noexcept {
    const LaneIndex x = Truncated(px), y = Truncated(py), z = Truncated(pz);
    std::array<const float*, kLanes> near;
    for (std::size_t k = 0; k < kLanes; ++k)
      near[k] = coarse.distance_.data() + coarse.Index(x[k], y[k], z[k]);
    const auto corner = [&](std::ptrdiff_t offset) LASCAUX_INLINED {
      return Each([&](std::size_t k) LASCAUX_INLINED { return near[k][offset]; });
    };
    const std::ptrdiff_t row = coarse.row_, slice = coarse.slice_;
    const Lanes fx = px - AsFloats(x), fy = py - AsFloats(y), fz = pz - AsFloats(z);
    const Lanes low = Mix(Mix(corner(0), corner(1), fx), Mix(corner(row), corner(row + 1), fx), fy);
    const Lanes high = Mix(Mix(corner(slice), corner(slice + 1), fx),
                           Mix(corner(slice + row), corner(slice + row + 1), fx), fy);
    return Mix(low, high, fz);
  }
};

}  // namespace lascaux

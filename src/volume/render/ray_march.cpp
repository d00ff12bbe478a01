#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <vector>

#include "lascaux/field/compiled_field.h"
#include "volume/render/coarse_lanes.h"
#include "volume/render/surface.h"

/// @file
/// Surface::Hit: rays step through empty space with the coarse field, and near the surface with the
/// band's distances.

namespace lascaux {
namespace {

/// Above this many strides a step with the coarse field is longer than one with the band.
constexpr float kCoarseRange = 1.4F;
/// Share of a distance that is stepped: fields are not quite distances where parts blend.
constexpr float kStepShare = 0.9F;
// In voxels. The least step bounds the work for rays that graze the surface; guessed steps stay
// below the thinnest features that a grid can hold.
constexpr float kLeastStep = 0.15F;
constexpr float kLongestGuess = 1.2F;
constexpr float kOvershoot = 0.06F;
constexpr float kClose = 0.02F;
constexpr int kRefinements = 2;
/// Share of the band within which the next step looks at the band first.
constexpr float kBandEdge = 0.95F;
constexpr float kFarthest = 1e9F;  // voxels
constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Places along eight rays, and their distances from the surface.
struct Probes {
  Lanes t, distance;

  LASCAUX_INLINE void TakeFrom(const LaneMask& mask, const Lanes& places, const Lanes& distances) {
    Take(mask, places, t);
    Take(mask, distances, distance);
  }
};

/// The last place outside and the first one inside, of each ray.
struct Brackets {
  explicit Brackets(std::size_t count)
      : outside(count), outside_distance(count), inside(count, kNothing), inside_distance(count) {}

  std::vector<float> outside, outside_distance, inside, inside_distance;
};

LASCAUX_INLINE Lanes ValuesAt(const float* const* leaves, const LaneIndex& leaf,
                              const LaneIndex& in_leaf) {
  return Each([&](std::size_t k) LASCAUX_INLINED { return leaves[leaf[k]][in_leaf[k]]; });
}

LASCAUX_INLINE Lanes Crossing(const Probes& a, const Probes& b) {
  return a.t + (b.t - a.t) * a.distance / (a.distance - b.distance);
}

LASCAUX_INLINE LaneIndex Chosen(const LaneMask& mask, std::int32_t yes, std::int32_t no) {
  return mask ? LaneIndex{} + yes : LaneIndex{} + no;
}

/// The least multiple of kLanes that is not below `count`.
std::size_t WholeLanes(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

}  // namespace

/// Rays on their way, eight at once. Which of them share their steps changes none of them.
class RayMarch {
 public:
  RayMarch(const Surface& surface, const Rays& rays)
      : surface_(surface), rays_(rays), brackets_(WholeLanes(rays.size())) {}

  /// First places inside.
  LASCAUX_INLINE std::vector<float> Run() {
    for (std::size_t k = 0; k < kLanes; ++k) Enter(k);
    while (busy_ != 0) {
      std::uint64_t over = busy_ & ~BitsOf(OnWay());
      if (over == 0) Step();
      for (; over != 0; over &= over - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(over));
        Leave(k);
        Enter(k);
      }
    }
    std::vector<float> found(WholeLanes(rays_.size()), kNothing);
    for (std::size_t i = 0; i < rays_.size(); i += kLanes) Refine(i, found.data() + i);
    found.resize(rays_.size());
    return found;
  }

 private:
  LASCAUX_INLINE LaneMask OnWay() const { return ~is_inside_ & (t_ < end_); }

  /// Takes the next ray into a lane, if there is one.
  LASCAUX_INLINE void Enter(std::size_t lane) {
    if (next_ == rays_.size()) {
      busy_ &= ~(std::uint64_t{1} << lane);
      t_[lane] = end_[lane] = 0;
      return;
    }
    const std::size_t i = next_++;
    busy_ |= std::uint64_t{1} << lane;
    ray_[lane] = i;
    const Eigen::Vector3f way(rays_.x[i], rays_.y[i], rays_.z[i]);
    const auto [begin, end] = Clip(way);
    way_.x[lane] = way.x(), way_.y[lane] = way.y(), way_.z[lane] = way.z();
    t_[lane] = last_.t[lane] = std::max(begin, rays_.from[i]);
    end_[lane] = end;
    last_.distance[lane] = surface_.band_;
    in_band_[lane] = is_inside_[lane] = 0;
  }

  LASCAUX_INLINE void Leave(std::size_t lane) {
    if (is_inside_[lane] == 0) return;
    const std::size_t i = ray_[lane];
    brackets_.outside[i] = last_.t[lane];
    brackets_.outside_distance[i] = last_.distance[lane];
    brackets_.inside[i] = t_[lane];
    brackets_.inside_distance[i] = distance_[lane];
  }

  /// Part of a ray within the surface's box, or an empty range.
  std::array<float, 2> Clip(const Eigen::Vector3f& way) const {
    std::array<float, 2> range = {0, kFarthest};
    for (int axis = 0; axis < 3; ++axis) {
      // Infinite for parallel rays, which sorts itself out.
      const float inverse = 1 / way[axis];
      const float a = (surface_.low_[axis] - rays_.origin[axis]) * inverse;
      const float b = (surface_.high_[axis] - rays_.origin[axis]) * inverse;
      range[0] = std::max(range[0], std::min(a, b));
      range[1] = std::min(range[1], std::max(a, b));
    }
    return range;
  }

  /// What more of the rays wait for: a step in the air or one in the band.
  LASCAUX_INLINE void Step() {
    const LaneMask on_way = OnWay(), in_air = on_way & ~in_band_;
    if (2 * std::popcount(BitsOf(in_air)) >= std::popcount(BitsOf(on_way)))
      StepInAir(in_air);
    else
      StepInBand(on_way & in_band_);
  }

  LASCAUX_INLINE void StepInAir(const LaneMask& mask) {
    const float stride = surface_.coarse_->stride();
    const Lanes rough = CoarseLanes{*surface_.coarse_}.At(PlacesAt(t_, way_));
    const LaneMask near = mask & (rough <= kCoarseRange * stride);
    last_.TakeFrom(near, t_, All(surface_.band_));
    in_band_ |= near;
    Take(mask & ~near, t_ + (rough - CoarseField::kError * stride), t_);
  }

  LASCAUX_INLINE void StepInBand(const LaneMask& mask) {
    const Lanes distance = DistancesAt(mask, PlacesAt(t_, way_));
    Take(mask, distance, distance_);
    is_inside_ |= mask & (distance <= 0);
    const LaneMask on = mask & ~is_inside_;
    const float band = surface_.band_;
    in_band_ = on ? (distance < kBandEdge * band) : in_band_;
    Lanes length = Max(kStepShare * distance, All(kLeastStep));
    // Where the distance shrinks steadily the surface is a little beyond the place where it would
    // be 0.
    const Lanes slope = (last_.distance - distance) / (t_ - last_.t);
    Take((last_.distance < band) & (slope > 0),
         Max(length, Min(distance / slope, All(kLongestGuess)) + kOvershoot), length);
    last_.TakeFrom(on, t_, distance);
    Take(on, t_ + length, t_);
  }

  /// Where the sign changes along the rays from number `first` on.
  LASCAUX_INLINE void Refine(std::size_t first, float* out) const {
    Probes outside{Load(brackets_.outside.data() + first),
                   Load(brackets_.outside_distance.data() + first)};
    Probes inside{Load(brackets_.inside.data() + first),
                  Load(brackets_.inside_distance.data() + first)};
    const auto ways = [&](const std::vector<float>& of) LASCAUX_INLINED {
      return Each([&](std::size_t k)
                      LASCAUX_INLINED { return of[std::min(first + k, of.size() - 1)]; });
    };
    const LanePoint way{ways(rays_.x), ways(rays_.y), ways(rays_.z)};
    LaneMask open = (inside.t < kNothing) & (inside.t > outside.t);
    Lanes found = inside.t;
    for (int i = 0; i < kRefinements && BitsOf(open) != 0; ++i) {
      const Lanes t = Crossing(outside, inside);
      const Lanes distance = DistancesAt(open, PlacesAt(t, way));
      Take(open, t, found);
      open &= (distance >= kClose) | (distance <= -kClose);
      outside.TakeFrom(open & (distance > 0), t, distance);
      inside.TakeFrom(open & ~(distance > 0), t, distance);
    }
    Take(open, Crossing(outside, inside), found);
    Store(found, out);
  }

  LASCAUX_INLINE LanePoint PlacesAt(const Lanes& t, const LanePoint& way) const {
    const Eigen::Vector3f& eye = rays_.origin;
    return {eye.x() + t * way.x, eye.y() + t * way.y, eye.z() + t * way.z};
  }

  /// Distances in voxels at the places in `mask`, which are within the table's box, less one voxel.
  LASCAUX_INLINE Lanes DistancesAt(const LaneMask& mask, const LanePoint& p) const {
    const Eigen::Vector3f& origin = surface_.origin_;
    const Lanes corner{};  // for the others, which may be anywhere
    return TrilinearAt({mask ? p.x - origin.x() : corner, mask ? p.y - origin.y() : corner,
                        mask ? p.z - origin.z() : corner});
  }

  /// At places from the table's corner on. One cell in three reaches over leaves, which no branch
  /// predicts: each corner is looked up by itself.
  LASCAUX_INLINE Lanes TrilinearAt(const LanePoint& local) const {
    constexpr std::int32_t kLast = Surface::kLeafSize - 1;
    constexpr int kLog = Surface::kLeafLog;
    // Positive: truncation is floor.
    const LaneIndex x = Truncated(local.x), y = Truncated(local.y), z = Truncated(local.z);
    const LaneIndex in_x = x & kLast, in_y = y & kLast, in_z = z & kLast;
    const LaneMask over_x = in_x == kLast, over_y = in_y == kLast, over_z = in_z == kLast;
    const std::int32_t row = surface_.size_[2], slice = surface_.size_[1] * row;
    const LaneIndex next_x = Chosen(over_x, Surface::kStrideX * -kLast, Surface::kStrideX);
    const LaneIndex next_y = Chosen(over_y, Surface::kStrideY * -kLast, Surface::kStrideY);
    const LaneIndex next_z = Chosen(over_z, -kLast, 1);
    const Lanes fx = local.x - AsFloats(x), fy = local.y - AsFloats(y);
    const Lanes fz = local.z - AsFloats(z);
    const float* const* const leaves = surface_.leaves_.data();
    const auto along_z = [&](const LaneIndex& leaf, const LaneIndex& in_leaf) LASCAUX_INLINED {
      return Mix(ValuesAt(leaves, leaf, in_leaf),
                 ValuesAt(leaves, leaf + (over_z & 1), in_leaf + next_z), fz);
    };
    const auto along_y = [&](const LaneIndex& leaf, const LaneIndex& in_leaf) LASCAUX_INLINED {
      return Mix(along_z(leaf, in_leaf), along_z(leaf + (over_y & row), in_leaf + next_y), fy);
    };
    const LaneIndex leaf = (x >> kLog) * slice + (y >> kLog) * row + (z >> kLog);
    const LaneIndex in_leaf = in_x * Surface::kStrideX + in_y * Surface::kStrideY + in_z;
    return surface_.per_voxel_ *
           Mix(along_y(leaf, in_leaf), along_y(leaf + (over_x & slice), in_leaf + next_x), fx);
  }

  const Surface& surface_;
  const Rays& rays_;
  Brackets brackets_;
  std::size_t next_ = 0;    ///< ray that enters next
  std::uint64_t busy_ = 0;  ///< lanes with a ray
  std::array<std::size_t, kLanes> ray_ = {};
  LanePoint way_{};
  Lanes t_{}, end_{}, distance_{};
  Probes last_{};  ///< outside
  LaneMask in_band_{}, is_inside_{};
};

namespace {

// The same code twice. Without fused multiplications, which AVX2 by itself has not, the bits agree.
std::vector<float> RunBaseline(RayMarch& march) { return march.Run(); }
#if defined(__x86_64__)
[[gnu::target("avx2")]] std::vector<float> RunAvx2(RayMarch& march) { return march.Run(); }
#else
constexpr auto RunAvx2 = RunBaseline;
#endif

}  // namespace

std::vector<float> Surface::Hit(const Rays& rays) const {
  RayMarch march(*this, rays);
  return BestIsa() == Isa::kBaseline ? RunBaseline(march) : RunAvx2(march);
}

}  // namespace lascaux

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ball_bounds.h"

namespace lascaux {
namespace {

using internal::kBoundTile;
using internal::Range;

constexpr std::size_t kBalls = 8, kLanes = kBoundTile;
static_assert(kLanes == 2 * kBalls, "a lane for each ball and one for the smaller one in it");

/// A number for each ball.
using Lanes = std::array<float, kLanes>;

/// One bit a lane.
using LaneBits = std::uint32_t;
constexpr LaneBits kOuter = (1U << kBalls) - 1;

struct LaneRanges {
  Lanes lower{}, upper{};

  void Add(const internal::KernelBounds& bounds) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      // What does not reach a ball is 0 there.
      lower[k] += bounds.upper[k] > 0 ? bounds.lower[k] : 0;
      upper[k] += bounds.upper[k];
    }
  }

  void Set(std::size_t k, const Range& range) {
    lower[k] = static_cast<float>(range.lower);
    upper[k] = static_cast<float>(range.upper);
  }
  Range Of(std::size_t k) const { return {lower[k], upper[k]}; }
};

LaneRanges Blended(const LaneRanges& a, const LaneRanges& b, const internal::RicciExponent& n) {
  LaneRanges blended;
  for (std::size_t k = 0; k < kLanes; ++k) blended.Set(k, Ricci(a.Of(k), b.Of(k), n));
  return blended;
}

/// A part that reaches some of the balls, with its own primitives in the list that is being made.
struct Reached {
  std::uint32_t part = 0;
  std::size_t begin = 0, end = 0;
  LaneRanges own, branch;  ///< by itself, and blended with its parent
  int parent = -1;
  LaneBits matters = 0;
};

/// Goes through a list of primitives, bounds each on all balls and adds up.
class BallsPass {
 public:
  BallsPass(const CompiledField::Data& data, const BallsAround& balls, BoundsAround reuse)
      : data_(data), balls_(balls), result_(std::move(reuse)) {
    result_.primitives.clear();
    result_.balls.clear();
    for (std::size_t k = 0; k < kLanes; ++k) {
      const auto toward = [&](std::size_t bit) { return (k & bit) != 0 ? 1.0 : -1.0; };
      centers_[k] = balls.center + balls.offset * Eigen::Vector3d(toward(4), toward(2), toward(1));
    }
  }

  BoundsAround Run(const ActiveSet& in) {
    const auto end = in.primitives.end();
    for (auto id = in.primitives.begin(); id != end;) {
      const CompiledPart& part = data_.part_of(data_.primitives[*id]);
      const auto behind = std::lower_bound(id, end, part.end);
      if (Enter(part)) {
        std::for_each(id, behind, [this](std::uint32_t i) { Consider(i); });
        EndPart();
      }
      id = behind;
    }
    Finish();
    return std::move(result_);
  }

 private:
  double RadiusOf(std::size_t lane) const {
    return lane < kBalls || balls_.inner == 0 ? balls_.radius : balls_.inner;
  }

  bool Enter(const CompiledPart& part);
  void FlattenBalls(const CompiledPart& part);
  void Consider(std::uint32_t id);
  LaneBits LanesAtBox(const Eigen::AlignedBox3d& box) const;
  internal::KernelBounds BoundsOf(const CompiledPrimitive& primitive) const;
  void EndChain();
  void EndPart();
  void Finish();

  const CompiledField::Data& data_;
  const BallsAround& balls_;
  BoundsAround result_;
  std::array<Eigen::Vector3d, kLanes> centers_;
  std::vector<Reached> reached_;

  // In the flat space of the part at hand.
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double around_ = 0;            ///< radius of a ball around all
  Lanes x_{}, y_{}, z_{}, r_{};  ///< the balls, from the origin

  LaneBits reach_ = 0;  ///< the balls that reach it in the plane

  std::uint32_t chain_ = ~0u;
  bool has_begun_ = false;  ///< the part at hand is in the list of those that reach balls
  bool has_chain_ = false;  ///< it has a chain that is complete
  LaneRanges chain_ranges_;
};

/// False when no ball reaches the part.
bool BallsPass::Enter(const CompiledPart& part) {
  // The plane is as it was: what is too far away there is, whatever its depth.
  reach_ = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto beyond = [&](int axis) {
      const double at = centers_[k][axis];
      return std::max({part.box.min()[axis] - at, at - part.box.max()[axis], 0.0});
    };
    const double x = beyond(0), y = beyond(1), radius = RadiusOf(k);
    reach_ |= LaneBits{x * x + y * y <= radius * radius} << k;
  }
  if ((reach_ & kOuter) == 0) return false;
  FlattenBalls(part);
  return part.box.squaredExteriorDistance(origin_) <= around_ * around_;
}

/// The flat space stretches balls along z, and a depth map shifts them by amounts that differ from
/// place to place: the balls around what they become.
void BallsPass::FlattenBalls(const CompiledPart& part) {
  origin_ = internal::Flatten(part, balls_.center);
  around_ = 0;
  const std::size_t different = balls_.inner > 0 ? kLanes : kBalls;
  for (std::size_t k = 0; k < different; ++k) {
    Ball flat{centers_[k], RadiusOf(k)};
    if ((reach_ >> k & 1) == 0) {
      flat = {origin_, 0};
    } else if (part.map) {
      flat = internal::FlattenBall(part, flat);
    } else {
      flat.center = internal::Flatten(part, flat.center);
      flat.radius *= std::max(1.0, part.inv_depth_scale);
    }
    const Eigen::Vector3d off = flat.center - origin_;
    x_[k] = static_cast<float>(off.x());
    y_[k] = static_cast<float>(off.y());
    z_[k] = static_cast<float>(off.z());
    r_[k] = static_cast<float>(flat.radius);
    around_ = std::max(around_, off.norm() + flat.radius);
  }
  for (Lanes* lanes : {&x_, &y_, &z_, &r_})
    std::copy_n(lanes->begin(), kLanes - different, lanes->begin() + different);
}

/// The balls that reach a box.
LaneBits BallsPass::LanesAtBox(const Eigen::AlignedBox3d& box) const {
  const Eigen::Vector3f low = (box.min() - origin_).cast<float>();
  const Eigen::Vector3f high = (box.max() - origin_).cast<float>();
  const auto beyond = [&](int axis, float at) {
    return std::max({low[axis] - at, at - high[axis], 0.0F});
  };
  LaneBits bits = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float x = beyond(0, x_[k]), y = beyond(1, y_[k]), z = beyond(2, z_[k]);
    constexpr float kRounding = 1.0001F;
    const float reach = kRounding * r_[k];
    bits |= LaneBits{x * x + y * y + z * z <= reach * reach} << k;
  }
  return bits;
}

internal::KernelBounds BallsPass::BoundsOf(const CompiledPrimitive& primitive) const {
  internal::KernelBounds bounds;
  if (primitive.is_point()) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Eigen::Vector3d center = origin_ + Eigen::Vector3d(x_[k], y_[k], z_[k]);
      const Range range =
          internal::RangeOfPoint(primitive, (center - primitive.place).norm(), r_[k]);
      bounds.lower[k] = static_cast<float>(range.lower);
      bounds.upper[k] = static_cast<float>(range.upper);
    }
    return bounds;
  }
  internal::KernelBalls tile;
  const double inverse = 1 / primitive.radius;
  const Eigen::Vector3f w = ((origin_ - primitive.place) * inverse).cast<float>();
  const auto scale = static_cast<float>(inverse);
  for (std::size_t k = 0; k < kLanes; ++k) {
    tile.x[k] = w.x() + scale * x_[k];
    tile.y[k] = w.y() + scale * y_[k];
    tile.z[k] = w.z() + scale * z_[k];
    tile.radius[k] = scale * r_[k];
    tile.ux[k] = primitive.ux;
    tile.uy[k] = primitive.uy;
    tile.uz[k] = primitive.uz;
    tile.slope[k] = primitive.slope;
    tile.y_end[k] = primitive.y_end;
    tile.length[k] = primitive.length;
  }
  data_.kernel->bounds(tile, &bounds);
  // Cones that are about as wide as long are not tested for what they reach, and nothing is known
  // of tips.
  constexpr float kSteep = 0.49F;
  if (primitive.slope > -kSteep && !primitive.tip) return bounds;
  const LaneBits at_box = LanesAtBox(primitive.box);
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (primitive.tip) {
      bounds.lower[k] = 0;
      bounds.upper[k] = internal::kAnything;
    }
    if ((at_box >> k & 1) == 0) bounds.upper[k] = 0;
  }
  return bounds;
}

void BallsPass::Consider(std::uint32_t id) {
  const CompiledPrimitive& primitive = data_.primitives[id];
  if (primitive.box.squaredExteriorDistance(origin_) > around_ * around_) return;
  internal::KernelBounds bounds = BoundsOf(primitive);
  LaneBits reached = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    if ((reach_ >> k & 1) == 0) bounds.upper[k] = 0;
    reached |= LaneBits{bounds.upper[k] > 0} << k;
  }
  reached &= kOuter;
  if (reached == 0) return;
  if (!has_begun_) {
    reached_.emplace_back();
    reached_.back().part = data_.chain_part[primitive.chain];
    reached_.back().begin = result_.primitives.size();
    has_begun_ = true;
  }
  if (primitive.chain != chain_) {
    EndChain();
    chain_ = primitive.chain;
  }
  chain_ranges_.Add(bounds);
  result_.primitives.push_back(id);
  result_.balls.push_back(static_cast<std::uint8_t>(reached));
}

void BallsPass::EndChain() {
  if (chain_ == ~0u) return;
  LaneRanges& own = reached_.back().own;
  own = has_chain_ ? Blended(own, chain_ranges_, data_.chain_exponent) : chain_ranges_;
  has_chain_ = true;
  chain_ranges_ = {};
  chain_ = ~0u;
}

void BallsPass::EndPart() {
  EndChain();
  if (has_begun_) reached_.back().end = result_.primitives.size();
  has_begun_ = has_chain_ = false;
}

void BallsPass::Finish() {
  internal::BlendWithParents(reached_, data_, Blended);
  constexpr auto kSlack = static_cast<float>(kBoundSlack);
  LaneRanges all;
  for (const Reached& here : reached_) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      all.lower[k] = std::max(all.lower[k], here.branch.lower[k] * (1 - kSlack));
      all.upper[k] = std::max(all.upper[k], here.branch.upper[k] * (1 + kSlack));
    }
  }
  // A branch that stays below another one everywhere on a ball never is the maximum there. Its
  // primitives go, unless a child's branch that may be needs them.
  for (Reached& here : reached_) {
    for (std::size_t k = 0; k < kBalls; ++k)
      here.matters |= LaneBits{here.branch.upper[k] * (1 + kSlack) >= all.lower[k]} << k;
    if (here.parent >= 0) reached_[static_cast<std::size_t>(here.parent)].matters |= here.matters;
  }
  for (const Reached& here : reached_) {
    for (std::size_t i = here.begin; i < here.end; ++i)
      result_.balls[i] &= static_cast<std::uint8_t>(here.matters & kOuter);
  }
  for (std::size_t k = 0; k < kBalls; ++k) {
    const auto on_ball = [&](std::size_t lane) {
      return internal::Amplified({all.lower[lane], all.upper[lane]},
                                 {centers_[lane], RadiusOf(lane)}, data_);
    };
    const FieldBounds outer = result_.bounds[k] = on_ball(k);
    constexpr auto kSurface = static_cast<float>(kIsoValue);
    if (outer.lower <= kSurface && outer.upper >= kSurface) result_.inner[k] = on_ball(kBalls + k);
  }
}

}  // namespace

ActiveSet BoundsAround::Active(std::size_t ball, ActiveSet reuse) const {
  const auto is_there = [&](std::uint8_t in) { return (in >> ball & 1) != 0; };
  reuse.primitives.clear();
  reuse.primitives.reserve(
      static_cast<std::size_t>(std::count_if(balls.begin(), balls.end(), is_there)));
  for (std::size_t i = 0; i < primitives.size(); ++i)
    if (is_there(balls[i])) reuse.primitives.push_back(primitives[i]);
  return reuse;
}

BoundsAround CompiledField::BoundOnBalls(const BallsAround& balls, const ActiveSet& in,
                                         BoundsAround reuse) const {
  return BallsPass(*data_, balls, std::move(reuse)).Run(in);
}

}  // namespace lascaux

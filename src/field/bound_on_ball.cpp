#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ball_bounds.h"

namespace lascaux {
namespace {

using internal::kAnything;
using internal::kBoundTile;
using internal::KernelBalls;
using internal::KernelBounds;
using internal::Range;

/// A part that reaches the ball, with its own primitives in the list that is being made.
struct Reached {
  std::uint32_t part = 0;
  std::size_t begin = 0, end = 0;
  Range own{};
  Range branch{};  ///< blended with its parent
  int parent = -1;
  bool matters = true;
};

/// As many parts as reach one ball, mostly.
constexpr std::size_t kUsualParts = 8;

/// Goes through a list of primitives, bounds each on the ball and adds up.
class BallPass {
 public:
  BallPass(const CompiledField::Data& data, const Ball& ball, std::vector<std::uint32_t> kept)
      : data_(data), ball_(ball), kept_(std::move(kept)) {
    kept_.clear();
    reached_.reserve(kUsualParts);
  }

  BallBounds Run(const ActiveSet& in) {
    const auto end = in.primitives.end();
    for (auto id = in.primitives.begin(); id != end;) {
      const CompiledPart& part = data_.part_of(data_.primitives[*id]);
      const auto behind = std::lower_bound(id, end, part.end);
      if (Enter(part)) std::for_each(id, behind, [this](std::uint32_t i) { Consider(i); });
      id = behind;
    }
    Flush();
    EndPart();
    return Finish();
  }

 private:
  bool Enter(const CompiledPart& part);
  void Consider(std::uint32_t id);
  void Flush();
  void Take(std::uint32_t id, const Range& range);
  void EndChain();
  void EndPart();
  BallBounds Finish();

  const CompiledField::Data& data_;
  const Ball& ball_;
  std::vector<std::uint32_t> kept_;
  std::vector<Reached> reached_;

  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();  ///< in the flat space of the part at hand
  double radius_ = 0;

  KernelBalls tile_;
  std::array<std::uint32_t, kBoundTile> tile_ids_;
  std::array<Range, kBoundTile> tile_ranges_;  ///< of points, which need no vector code
  int tile_count_ = 0;

  std::uint32_t chain_ = ~0u;
  Range chain_range_{};
};

/// The flat space stretches the ball along z, and a depth map shifts it by an amount that differs
/// from place to place: the ball around what it becomes. False when it does not reach the part.
bool BallPass::Enter(const CompiledPart& part) {
  const Eigen::Vector3d& center = ball_.center;
  const auto reaches = [&] {
    return part.box.squaredExteriorDistance(center_) <= radius_ * radius_;
  };
  // The plane is as it was: what is too far away there is, whatever its depth.
  center_ = {center.x(), center.y(), std::clamp(part.z0, part.box.min().z(), part.box.max().z())};
  radius_ = ball_.radius;
  if (!reaches()) return false;
  if (!part.map) {
    center_ = internal::Flatten(part, center);
    radius_ = ball_.radius * std::max(1.0, part.inv_depth_scale);
    return reaches();
  }
  const Ball flat = internal::FlattenBall(part, ball_);
  center_ = flat.center;
  radius_ = flat.radius;
  return reaches();
}

void BallPass::Consider(std::uint32_t id) {
  const CompiledPrimitive& primitive = data_.primitives[id];
  if (primitive.box.squaredExteriorDistance(center_) > radius_ * radius_) return;

  const auto k = static_cast<std::size_t>(tile_count_);
  tile_ids_[k] = id;
  if (primitive.is_point())
    tile_ranges_[k] =
        internal::RangeOfPoint(primitive, (center_ - primitive.place).norm(), radius_);
  const double inv_radius = 1 / primitive.radius;
  const Eigen::Vector3f w = ((center_ - primitive.place) * inv_radius).cast<float>();
  tile_.x[k] = w.x();
  tile_.y[k] = w.y();
  tile_.z[k] = w.z();
  tile_.ux[k] = primitive.ux;
  tile_.uy[k] = primitive.uy;
  tile_.uz[k] = primitive.uz;
  tile_.slope[k] = primitive.slope;
  tile_.y_end[k] = primitive.y_end;
  tile_.length[k] = primitive.length;
  tile_.radius[k] = static_cast<float>(radius_ * inv_radius);
  if (++tile_count_ == kBoundTile) Flush();
}

void BallPass::Flush() {
  if (tile_count_ == 0) return;
  const auto copy_first = [this](float* column) {
    std::fill(column + tile_count_, column + kBoundTile, column[0]);
  };
  for (float* column : {tile_.x, tile_.y, tile_.z, tile_.ux, tile_.uy, tile_.uz, tile_.slope,
                        tile_.y_end, tile_.length, tile_.radius}) {
    copy_first(column);
  }
  KernelBounds bounds;
  data_.kernel->bounds(tile_, &bounds);
  for (int k = 0; k < tile_count_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const CompiledPrimitive& primitive = data_.primitives[tile_ids_[i]];
    Range range{bounds.lower[k], bounds.upper[k]};
    if (primitive.is_point()) range = tile_ranges_[i];
    if (primitive.tip) range = {0, kAnything};
    if (range.upper > 0) Take(tile_ids_[i], range);
  }
  tile_count_ = 0;
}

void BallPass::Take(std::uint32_t id, const Range& range) {
  const std::uint32_t chain = data_.primitives[id].chain;
  const std::uint32_t part = data_.chain_part[chain];
  if (reached_.empty() || reached_.back().part != part) {
    EndPart();
    reached_.emplace_back();
    reached_.back().part = part;
    reached_.back().begin = kept_.size();
  }
  if (chain != chain_) {
    EndChain();
    chain_ = chain;
  }
  chain_range_.lower += range.lower;
  chain_range_.upper += range.upper;
  kept_.push_back(id);
}

void BallPass::EndChain() {
  if (chain_ == ~0u) return;
  Range& own = reached_.back().own;
  own = Ricci(own, chain_range_, data_.chain_exponent);
  chain_range_ = {};
  chain_ = ~0u;
}

void BallPass::EndPart() {
  EndChain();
  if (reached_.empty()) return;
  reached_.back().end = kept_.size();
}

BallBounds BallPass::Finish() {
  internal::BlendWithParents(reached_, data_, internal::Ricci);
  Range all{};
  for (const Reached& here : reached_) {
    all.lower = std::max(all.lower, here.branch.lower);
    all.upper = std::max(all.upper, here.branch.upper);
  }
  // A branch that stays below another one everywhere on the ball never is the maximum. Its
  // primitives go, unless a child's branch that may be needs them.
  const double reliable = all.lower * (1 - kBoundSlack);
  for (Reached& here : reached_) here.matters = false;
  for (Reached& here : reached_) {
    if (here.branch.upper * (1 + kBoundSlack) < reliable) continue;
    here.matters = true;
    if (here.parent >= 0) reached_[static_cast<std::size_t>(here.parent)].matters = true;
  }
  std::size_t count = 0;
  for (const Reached& here : reached_) {
    if (!here.matters) continue;
    std::copy(kept_.begin() + static_cast<std::ptrdiff_t>(here.begin),
              kept_.begin() + static_cast<std::ptrdiff_t>(here.end),
              kept_.begin() + static_cast<std::ptrdiff_t>(count));
    count += here.end - here.begin;
  }
  kept_.resize(count);
  return {{static_cast<float>(reliable), static_cast<float>(all.upper * (1 + kBoundSlack))},
          {std::move(kept_)}};
}

}  // namespace

BallBounds CompiledField::BoundOnBall(const Ball& ball, const ActiveSet& in,
                                      ActiveSet reuse) const {
  BallBounds found = BallPass(*data_, ball, std::move(reuse.primitives)).Run(in);
  found.bounds = internal::Amplified(found.bounds, ball, *data_);
  return found;
}

}  // namespace lascaux

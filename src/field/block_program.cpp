#include "block_program.h"

#include <cmath>
#include <limits>

namespace lascaux {

using internal::KernelChain;
using internal::KernelPoint;
using internal::KernelSegment;

namespace {

constexpr std::uint32_t kNone = ~0u;

internal::KernelExponent ForKernel(const internal::RicciExponent& exponent) {
  return {exponent.squarings(), static_cast<float>(exponent.n())};
}

}  // namespace

void Program::BeginPart(const CompiledField::Data& data, std::uint32_t part,
                        const Eigen::Vector3d& origin) {
  const CompiledPart& here = data.parts[part];
  const auto chains = static_cast<std::uint32_t>(chains_.size());
  const bool has_parent =
      here.depth > 0 && part_at_depth_[here.depth - 1] == static_cast<std::uint32_t>(here.parent);
  const int map = here.map ? static_cast<int>(maps_.size()) : -1;
  double steepness = here.inv_depth_scale, above = origin.z() - here.z0;
  if (here.map) {
    const DepthSample depth = EvaluateDepth(*here.map, origin.head<2>());
    internal::KernelTable table = here.table->From(origin.head<2>());
    table.shift = static_cast<float>(depth.middle);
    steepness = depth.steepness;
    above = origin.z() - depth.middle;
    maps_.push_back({table, static_cast<float>(origin.z() - static_cast<double>(table.shift)),
                     static_cast<float>(above * steepness)});
  }
  flat_origin_ = {origin.x(), origin.y(), here.z0 + above * steepness};
  steepness_.push_back(static_cast<float>(steepness));
  parts_.push_back(
      {chains, chains, here.depth, has_parent, static_cast<float>(here.inv_depth_scale), map});
  part_at_depth_[here.depth] = part;
}

namespace {

/// A primitive's support, a little larger than it is: outside of it the vector code's own rounding
/// leaves nothing, so that skipping a primitive changes no bit.
internal::KernelBox SupportFrom(const CompiledPrimitive& primitive, const Eigen::Vector3d& origin) {
  constexpr double kMargin = 1e-3;  // radii
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin * primitive.radius);
  const Eigen::Vector3f low = (primitive.box.min() - margin - origin).cast<float>();
  const Eigen::Vector3f high = (primitive.box.max() + margin - origin).cast<float>();
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

}  // namespace

void Program::Add(const CompiledPrimitive& primitive, const Eigen::Vector3d& origin) {
  const internal::KernelBox support = SupportFrom(primitive, origin);
  const Eigen::Vector3f w = ((origin - primitive.place) / primitive.radius).cast<float>();
  const auto inv_radius = static_cast<float>(1 / primitive.radius);
  if (primitive.is_point()) {
    points_.push_back({support, w.x(), w.y(), w.z(), inv_radius, primitive.norm});
    chains_.back().points_end = static_cast<std::uint32_t>(points_.size());
  } else {
    segments_.push_back({support, w.x(), w.y(), w.z(), primitive.ux, primitive.uy, primitive.uz,
                         inv_radius, primitive.slope, primitive.y_end});
    chains_.back().segments_end = static_cast<std::uint32_t>(segments_.size());
  }
}

Program::Program(const CompiledField::Data& data, const Eigen::Vector3d& origin,
                 const ActiveSet& active)
    : part_at_depth_(data.depths, kNone) {
  segments_.reserve(active.primitives.size());
  std::uint32_t part = kNone, chain = kNone;
  for (const std::uint32_t id : active.primitives) {
    const CompiledPrimitive& primitive = data.primitives[id];
    if (data.chain_part[primitive.chain] != part) {
      part = data.chain_part[primitive.chain];
      BeginPart(data, part, origin);
    }
    if (primitive.chain != chain) {
      chain = primitive.chain;
      const auto segments = static_cast<std::uint32_t>(segments_.size());
      const auto points = static_cast<std::uint32_t>(points_.size());
      chains_.push_back({segments, segments, points, points});
      parts_.back().chains_end = static_cast<std::uint32_t>(chains_.size());
    }
    Add(primitive, flat_origin_);
  }
  program_ = {segments_.data(),
              points_.data(),
              chains_.data(),
              parts_.data(),
              static_cast<std::uint32_t>(parts_.size()),
              ForKernel(data.chain_exponent),
              ForKernel(data.part_exponent),
              maps_.data(),
              data.gain ? data.gain->From(origin.head<2>()) : internal::KernelTable{}};
}

namespace {

/// Least radius of the part of a segment whose kernel reaches the ball around the origin, in larger
/// radii; infinite where none does. `reach` is the ball's radius in these.
float ThinnestOf(const KernelSegment& s, float reach) {
  const float x = s.x * s.ux + s.y * s.uy + s.z * s.uz;
  const float squared = s.x * s.x + s.y * s.y + s.z * s.z;
  const float length = s.y_end / (1 - s.slope * s.y_end);
  // Places p along the axis with |p - origin| <= 2 (1 + g p) + reach: the last of them.
  const float far = 2 + reach;
  const float a = 1 - 4 * s.slope * s.slope, b = x + 2 * s.slope * far, c = squared - far * far;
  constexpr float kLeast = 0.05F;  // of a: cones that are nearly as wide as long are taken whole
  if (a < kLeast) return 1 + s.slope * length;
  const float root = b * b - a * c;
  if (root < 0) return std::numeric_limits<float>::infinity();
  return 1 + s.slope * std::clamp((b + std::sqrt(root)) / a, 0.0F, length);
}

}  // namespace

float Program::ThinnestWithin(float reach) const {
  float thinnest = std::numeric_limits<float>::infinity();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const float steep = std::max(1.0F, steepness_[p]);
    for (std::uint32_t c = parts_[p].chains_begin; c < parts_[p].chains_end; ++c) {
      for (std::uint32_t i = chains_[c].segments_begin; i < chains_[c].segments_end; ++i) {
        const float inv_radius = segments_[i].inv_tau;
        thinnest = std::min(
            thinnest, ThinnestOf(segments_[i], steep * reach * inv_radius) / (steep * inv_radius));
      }
      for (std::uint32_t i = chains_[c].points_begin; i < chains_[c].points_end; ++i)
        thinnest = std::min(thinnest, 1 / (steep * points_[i].inv_radius));
    }
  }
  return thinnest;
}

int LoadColumn(std::span<const float> from, float* to) {
  const auto count = static_cast<int>(from.size());
  const int filled = (count + internal::kGroup - 1) / internal::kGroup * internal::kGroup;
  std::copy_n(from.data(), count, to);
  std::fill(to + count, to + filled, to[count - 1]);
  return filled;
}

int LoadTile(const PointBlock& block, std::size_t begin, internal::KernelPoints& tile) {
  const std::size_t count = std::min<std::size_t>(internal::kTile, block.x.size() - begin);
  LoadColumn(block.x.subspan(begin, count), tile.x);
  LoadColumn(block.y.subspan(begin, count), tile.y);
  tile.count = LoadColumn(block.z.subspan(begin, count), tile.z);
  return static_cast<int>(count);
}

}  // namespace lascaux

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "compiled_data.h"

namespace lascaux {
namespace {

using internal::KernelChain;
using internal::KernelPart;
using internal::KernelPoint;
using internal::KernelSamples;
using internal::KernelSegment;
using internal::kTile;

/// A part with a depth map that a block needs.
struct Mapped {
  const CompiledPart* part;
  double origin_z;  ///< of the block, in the part's flat space
};

/// The primitives that a block needs, seen from its origin: differences are taken in double
/// precision, so that what the vector code loses depends on the block's size and not on its place.
class Program {
 public:
  Program(const CompiledField::Data& data, const Eigen::Vector3d& origin, const ActiveSet& active);

  const internal::KernelProgram& kernel_program() const { return program_; }
  const std::vector<Mapped>& mapped() const { return mapped_; }

 private:
  void BeginPart(const CompiledField::Data& data, std::uint32_t part, double origin_z);
  void Add(const CompiledPrimitive& primitive, const Eigen::Vector3d& origin);

  std::vector<KernelSegment> segments_;
  std::vector<KernelPoint> points_;
  std::vector<KernelChain> chains_;
  std::vector<KernelPart> parts_;
  std::vector<std::uint32_t> part_at_depth_;
  std::vector<Mapped> mapped_;
  internal::KernelProgram program_{};
};

constexpr std::uint32_t kNone = ~0u;

internal::KernelExponent ForKernel(const internal::RicciExponent& exponent) {
  return {exponent.squarings(), static_cast<float>(exponent.n())};
}

void Program::BeginPart(const CompiledField::Data& data, std::uint32_t part, double origin_z) {
  const CompiledPart& here = data.parts[part];
  const auto chains = static_cast<std::uint32_t>(chains_.size());
  const bool has_parent =
      here.depth > 0 && part_at_depth_[here.depth - 1] == static_cast<std::uint32_t>(here.parent);
  const int map = here.map ? static_cast<int>(mapped_.size()) : -1;
  if (here.map) mapped_.push_back({&here, origin_z});
  parts_.push_back(
      {chains, chains, here.depth, has_parent, static_cast<float>(here.inv_depth_scale), map});
  part_at_depth_[here.depth] = part;
}

/// A primitive's support, a little larger than it is: outside of it the vector code's own rounding
/// leaves nothing, so that skipping a primitive changes no bit.
internal::KernelBox SupportFrom(const CompiledPrimitive& primitive, const Eigen::Vector3d& origin) {
  constexpr double kMargin = 1e-3;  // radii
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin * primitive.radius);
  const Eigen::Vector3f low = (primitive.box.min() - margin - origin).cast<float>();
  const Eigen::Vector3f high = (primitive.box.max() + margin - origin).cast<float>();
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

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
  Eigen::Vector3d flat_origin = origin;
  for (const std::uint32_t id : active.primitives) {
    const CompiledPrimitive& primitive = data.primitives[id];
    if (data.chain_part[primitive.chain] != part) {
      part = data.chain_part[primitive.chain];
      flat_origin = internal::Flatten(data.parts[part], origin);
      BeginPart(data, part, flat_origin.z());
    }
    if (primitive.chain != chain) {
      chain = primitive.chain;
      const auto segments = static_cast<std::uint32_t>(segments_.size());
      const auto points = static_cast<std::uint32_t>(points_.size());
      chains_.push_back({segments, segments, points, points});
      parts_.back().chains_end = static_cast<std::uint32_t>(chains_.size());
    }
    Add(primitive, flat_origin);
  }
  program_ = {segments_.data(),
              points_.data(),
              chains_.data(),
              parts_.data(),
              static_cast<std::uint32_t>(parts_.size()),
              ForKernel(data.chain_exponent),
              ForKernel(data.part_exponent),
              nullptr};
}

/// The points from `begin` on; a last tile is filled up with its last point, so that every point
/// goes through the same code.
int LoadTile(const PointBlock& block, std::size_t begin, internal::KernelPoints& tile) {
  const auto count = static_cast<int>(std::min<std::size_t>(kTile, block.x.size() - begin));
  const auto load = [&](std::span<const float> from, float* to) {
    std::copy_n(from.data() + begin, count, to);
    std::fill(to + count, to + kTile, to[count - 1]);
  };
  load(block.x, tile.x);
  load(block.y, tile.y);
  load(block.z, tile.z);
  return count;
}

/// The depths of `count` points from `begin` on in the flat space of a part. Blocks run along z
/// first: the place is often the one before.
void FillDepths(const Mapped& mapped, const PointBlock& points, std::size_t begin, int count,
                internal::KernelDepths& depths) {
  DepthSample here;
  float x = 0, y = 0;
  for (int i = 0; i < count; ++i) {
    const std::size_t k = begin + static_cast<std::size_t>(i);
    if (i == 0 || points.x[k] != x || points.y[k] != y) {
      x = points.x[k];
      y = points.y[k];
      here = EvaluateDepth(*mapped.part->map,
                           points.origin.head<2>() +
                               Eigen::Vector2d(static_cast<double>(x), static_cast<double>(y)));
    }
    const double off = points.origin.z() + static_cast<double>(points.z[k]) - here.middle;
    const double flat = mapped.part->z0 + off * here.steepness;
    depths.z[i] = static_cast<float>(flat - mapped.origin_z);
    depths.by_x[i] = static_cast<float>(off * here.steepness_gradient.x() -
                                        here.steepness * here.middle_gradient.x());
    depths.by_y[i] = static_cast<float>(off * here.steepness_gradient.y() -
                                        here.steepness * here.middle_gradient.y());
    depths.by_z[i] = static_cast<float>(here.steepness);
  }
  for (float* column : {depths.z, depths.by_x, depths.by_y, depths.by_z}) {
    std::fill(column + count, column + kTile, column[count - 1]);
  }
}

/// Runs `kernel` over all tiles and hands each result with its place to `store`.
template <typename Kernel, typename Store>
void ForTiles(const CompiledField::Data& data, const PointBlock& points, const Program& program,
              Kernel kernel, Store store) {
  assert(points.y.size() == points.x.size() && points.z.size() == points.x.size());
  // Deep trees are rare; most need no memory from the heap.
  constexpr std::uint32_t kSlotsInPlace = 4;
  std::array<KernelSamples, kSlotsInPlace> in_place;
  std::vector<KernelSamples> on_heap(data.depths > kSlotsInPlace ? data.depths : 0);
  KernelSamples* slots = on_heap.empty() ? in_place.data() : on_heap.data();
  internal::KernelPoints tile;
  KernelSamples result;
  std::vector<internal::KernelDepths> depths(program.mapped().size());
  internal::KernelProgram kernel_program = program.kernel_program();
  kernel_program.depths = depths.data();
  for (std::size_t begin = 0; begin < points.x.size(); begin += kTile) {
    const int count = LoadTile(points, begin, tile);
    for (std::size_t m = 0; m < depths.size(); ++m) {
      FillDepths(program.mapped()[m], points, begin, count, depths[m]);
    }
    kernel(kernel_program, tile, slots, &result);
    store(result, begin, count);
  }
}

/// True when the gain changes anything on the block.
bool HasGain(const CompiledField::Data& data, const PointBlock& points) {
  if (!data.gain || points.x.empty()) return false;
  const auto [left, right] = std::minmax_element(points.x.begin(), points.x.end());
  const auto [bottom, top] = std::minmax_element(points.y.begin(), points.y.end());
  const Eigen::Vector2d low(static_cast<double>(*left), static_cast<double>(*bottom));
  const Eigen::Vector2d high(static_cast<double>(*right), static_cast<double>(*top)),
      origin = points.origin.head<2>();
  const LogGainRange range =
      RangeOf(*data.gain, {Eigen::Vector2d(origin + low), Eigen::Vector2d(origin + high)});
  return range.lower < 0 || range.upper > 0;
}

/// The gain at point `i` of a block. Blocks run along z first: the place is often the one before.
class GainAlong {
 public:
  GainAlong(const PlanarGain& gain, const PointBlock& points) : gain_(gain), points_(points) {}

  const LogGain& At(std::size_t i) {
    const float x = points_.x[i], y = points_.y[i];
    if (i == 0 || x != x_ || y != y_) {
      last_ = EvaluateLogGain(gain_,
                              points_.origin.head<2>() +
                                  Eigen::Vector2d(static_cast<double>(x), static_cast<double>(y)));
      last_.value = std::exp(last_.value);
      x_ = x;
      y_ = y;
    }
    return last_;
  }

 private:
  const PlanarGain& gain_;
  const PointBlock& points_;
  float x_ = 0, y_ = 0;
  LogGain last_;
};

}  // namespace

void CompiledField::EvaluateValues(const PointBlock& points, const ActiveSet& active,
                                   std::span<float> values) const {
  assert(values.size() == points.x.size());
  const Program program(*data_, points.origin, active);
  ForTiles(*data_, points, program, data_->kernel->values,
           [&](const KernelSamples& result, std::size_t begin, int count) {
             std::copy_n(result.value, count, values.data() + begin);
           });
  if (!HasGain(*data_, points)) return;
  GainAlong gain(*data_->gain, points);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= static_cast<float>(gain.At(i).value);
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
  if (!HasGain(*data_, points)) return;
  GainAlong gain(*data_->gain, points);
  for (std::size_t i = 0; i < samples.value.size(); ++i) {
    const LogGain& here = gain.At(i);
    const auto factor = static_cast<float>(here.value);
    const float value = samples.value[i];
    samples.value[i] = factor * value;
    samples.gradient_x[i] =
        factor * (samples.gradient_x[i] + value * static_cast<float>(here.gradient.x()));
    samples.gradient_y[i] =
        factor * (samples.gradient_y[i] + value * static_cast<float>(here.gradient.y()));
    samples.gradient_z[i] *= factor;
  }
}

void SignedDistances(const SampleBlock& samples, float limit, std::span<float> distances, Isa isa) {
  const internal::BlockKernel& kernel = internal::KernelFor(isa);
  KernelSamples tile;
  std::array<float, kTile> result;
  for (std::size_t begin = 0; begin < distances.size(); begin += kTile) {
    const auto count = static_cast<int>(std::min<std::size_t>(kTile, distances.size() - begin));
    const auto load = [&](std::span<float> from, float* to) {
      std::copy_n(from.data() + begin, count, to);
      std::fill(to + count, to + kTile, to[count - 1]);
    };
    load(samples.value, tile.value);
    load(samples.gradient_x, tile.x);
    load(samples.gradient_y, tile.y);
    load(samples.gradient_z, tile.z);
    kernel.distances(tile, limit, result.data());
    std::copy_n(result.data(), count, distances.data() + begin);
  }
}

}  // namespace lascaux

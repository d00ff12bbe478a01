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

/// The primitives that a block needs, seen from its origin: differences are taken in double
/// precision, so that what the vector code loses depends on the block's size and not on its place.
class Program {
 public:
  Program(const CompiledField::Data& data, const Eigen::Vector3d& origin, const ActiveSet& active);

  const internal::KernelProgram& kernel_program() const { return program_; }

 private:
  void BeginPart(const CompiledField::Data& data, std::uint32_t part,
                 const Eigen::Vector3d& origin);
  void Add(const CompiledPrimitive& primitive, const Eigen::Vector3d& origin);

  std::vector<KernelSegment> segments_;
  std::vector<KernelPoint> points_;
  std::vector<KernelChain> chains_;
  std::vector<KernelPart> parts_;
  std::vector<std::uint32_t> part_at_depth_;
  std::vector<internal::KernelMap> maps_;
  Eigen::Vector3d flat_origin_ = Eigen::Vector3d::Zero();  ///< of the part that was begun last
  internal::KernelProgram program_{};
};

constexpr std::uint32_t kNone = ~0u;

internal::KernelExponent ForKernel(const internal::RicciExponent& exponent) {
  return {exponent.squarings(), static_cast<float>(exponent.n())};
}

void Program::BeginPart(const CompiledField::Data& data, std::uint32_t part,
                        const Eigen::Vector3d& origin) {
  const CompiledPart& here = data.parts[part];
  flat_origin_ = internal::Flatten(here, origin);
  const auto chains = static_cast<std::uint32_t>(chains_.size());
  const bool has_parent =
      here.depth > 0 && part_at_depth_[here.depth - 1] == static_cast<std::uint32_t>(here.parent);
  const int map = here.map ? static_cast<int>(maps_.size()) : -1;
  if (here.map) {
    internal::KernelTable table = here.table->From(origin.head<2>());
    table.shift = static_cast<float>(EvaluateDepth(*here.map, origin.head<2>()).middle);
    maps_.push_back({table, static_cast<float>(origin.z() - static_cast<double>(table.shift)),
                     static_cast<float>(flat_origin_.z() - here.z0)});
  }
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
  for (std::size_t begin = 0; begin < points.x.size(); begin += kTile) {
    const int count = LoadTile(points, begin, tile);
    kernel(program.kernel_program(), tile, slots, &result);
    store(result, begin, count);
  }
}

}  // namespace

void CompiledField::EvaluateValues(const PointBlock& points, const ActiveSet& active,
                                   std::span<float> values) const {
  assert(values.size() == points.x.size());
  const Program program(*data_, points.origin, active);
  ForTiles(*data_, points, program, data_->kernel->values,
           [&](const KernelSamples& result, std::size_t begin, int count) {
             std::copy_n(result.value, count, values.data() + begin);
           });
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

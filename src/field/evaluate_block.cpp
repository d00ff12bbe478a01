#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "compiled_data.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

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

  /// Least radius of what reaches the ball of radius `reach` around the origin, about, in the
  /// direction in which its part is thinnest.
  float ThinnestWithin(float reach) const;

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
  std::vector<float> steepness_;                           ///< of each part at the origin
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

/// Numbers of a tile, filled up with the last one to a multiple of the widest vector, so that every
/// number goes through the same code. Returns how many that are.
int LoadColumn(std::span<const float> from, float* to) {
  const auto count = static_cast<int>(from.size());
  const int filled = (count + internal::kGroup - 1) / internal::kGroup * internal::kGroup;
  std::copy_n(from.data(), count, to);
  std::fill(to + count, to + filled, to[count - 1]);
  return filled;
}

/// The points from `begin` on, as many as fit; returns how many.
int LoadTile(const PointBlock& block, std::size_t begin, internal::KernelPoints& tile) {
  const std::size_t count = std::min<std::size_t>(kTile, block.x.size() - begin);
  LoadColumn(block.x.subspan(begin, count), tile.x);
  LoadColumn(block.y.subspan(begin, count), tile.y);
  tile.count = LoadColumn(block.z.subspan(begin, count), tile.z);
  return static_cast<int>(count);
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

// In steps. What is thinner may lie unseen between a lattice's nodes.
constexpr float kThinnest = 2;

/// What interpolation is taken to be off by at least, for the thinnest radius in steps. A
/// cylinder's field has a fourth derivative of 18 / radius^4 along its axis, and that is what
/// interpolation is off by on one axis; 3 / radius^4 was found where a block's edge touches thin
/// things and no check is near.
float LeastErrorFor(float thinnest) {
  constexpr float kShare = 10;
  const float squared = thinnest * thinnest;
  return kShare / (squared * squared);
}

// From its centre to its corners, in steps.
constexpr float kLatticeReach = 3.5F * 1.7320508F;

constexpr auto kIso = static_cast<float>(kIsoValue);

/// Places of a lattice's points along each axis, from its centre.
using Offsets = std::array<float, internal::kLatticeSide>;

Offsets OffsetsOf(double step) {
  Offsets offsets;
  for (std::size_t k = 0; k < offsets.size(); ++k)
    offsets[k] = static_cast<float>(step * (static_cast<double>(k) - 0.5 * (offsets.size() - 1)));
  return offsets;
}

/// Points of a lattice by their numbers, 64 x + 8 y + z.
struct LatticePoints {
  std::array<std::uint16_t, internal::kLatticePoints> which;
  std::size_t count = 0;
  std::array<float, internal::kLatticePoints> x, y, z;

  void Add(std::size_t at) { which[count++] = static_cast<std::uint16_t>(at); }
  void AddAll() {
    for (std::size_t i = 0; i < which.size(); ++i) Add(i);
  }
  void Place(const Offsets& offsets) {
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = offsets[which[i] / 64U];
      y[i] = offsets[which[i] / 8U % 8];
      z[i] = offsets[which[i] % 8U];
    }
  }
  PointBlock At(const Eigen::Vector3d& origin) const {
    return {origin, std::span(x).first(count), std::span(y).first(count),
            std::span(z).first(count)};
  }
};

/// The numbers of the lattice's points that show how well the nodes tell the rest.
using LatticeChecks = std::array<std::uint16_t, internal::kLatticeChecks>;

constexpr LatticeChecks ChooseChecks() {
  constexpr auto number = [](const std::array<int, 3>& at) {
    return static_cast<std::uint16_t>(64 * at[0] + 8 * at[1] + at[2]);
  };
  constexpr auto& kNodes = internal::kLatticeNodes;
  constexpr std::array<int, 4> kOff = {1, 3, 4, 6};  // an axis's other points
  LatticeChecks checks{};
  std::size_t check = 0;
  // Every other line of nodes along each axis, at each place off the nodes as often.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t u = 0; u < 4; ++u) {
      for (std::size_t w = u % 2; w < 4; w += 2) {
        std::array<int, 3> at{};
        at[axis] = kOff[(u + w / 2 * 2) % 4];
        at[(axis + 1) % 3] = kNodes[u];
        at[(axis + 2) % 3] = kNodes[w];
        checks[check++] = number(at);
      }
    }
  }
  for (std::size_t corner = 0; corner < internal::kChecksAWay; ++corner) {
    const auto side = [corner](std::size_t axis) { return 1 + (corner >> axis & 1); };
    checks[check++] = number({kOff[side(0)], kOff[side(1)], kOff[side(2)]});
  }
  return checks;
}

/// The points of a plane or a cube whose places along each axis are given; z fastest.
template <std::size_t kSide>
void PlaceProduct(std::span<const float> x, const std::array<float, kSide>& yz,
                  internal::KernelPoints& tile) {
  constexpr std::size_t kLayer = kSide * kSide;
  tile.count = static_cast<int>(x.size() * kLayer);
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::fill_n(tile.x + kLayer * i, kLayer, x[i]);
    for (std::size_t j = 0; j < kSide; ++j) {
      std::fill_n(tile.y + kLayer * i + kSide * j, kSide, yz[j]);
      std::copy_n(yz.begin(), kSide, tile.z + kLayer * i + kSide * j);
    }
  }
}

internal::KernelLattice LatticeFor(const Offsets& offsets) {
  static constexpr LatticeChecks kChecks = ChooseChecks();
  std::array<float, 4> nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k] = offsets[static_cast<std::size_t>(internal::kLatticeNodes[k])];
  internal::KernelLattice lattice;
  PlaceProduct(nodes, nodes, lattice.nodes);
  for (std::size_t i = 0; i < kTile; ++i) {
    lattice.columns.x[i] = offsets[i / offsets.size()];
    lattice.columns.y[i] = offsets[i % offsets.size()];
    lattice.columns.z[i] = 0;
  }
  lattice.columns.count = kTile;
  for (std::size_t i = 0; i < kChecks.size(); ++i) {
    const std::size_t at = kChecks[i];
    lattice.checks.x[i] = offsets[at / 64];
    lattice.checks.y[i] = offsets[at / 8 % 8];
    lattice.checks.z[i] = offsets[at % 8];
    lattice.check_at[i] = kChecks[i];
  }
  lattice.checks.count = internal::kLatticeChecks;
  return lattice;
}

/// Bit i is set where values[i] is above `limit`.
std::uint64_t BitsAbove(const float* values, float limit) {
  std::uint64_t bits = 0;
#if defined(__SSE2__)
  const __m128 limits = _mm_set1_ps(limit);
  for (std::size_t i = 0; i < kTile; i += 4) {
    const int four = _mm_movemask_ps(_mm_cmpgt_ps(_mm_loadu_ps(values + i), limits));
    bits |= static_cast<std::uint64_t>(four) << i;
  }
#else
  for (std::size_t i = 0; i < kTile; ++i) bits |= std::uint64_t{values[i] > limit} << i;
#endif
  return bits;
}

struct Interpolation {
  const Offsets& offsets;
  float least_error;
};

/// Which points of a lattice are inside; puts those that are too near to tell into `unsure`.
LatticeBits Interpolate(const CompiledField::Data& data, const Program& program,
                        const Interpolation& how, LatticePoints& unsure) {
  constexpr std::uint32_t kSlotsInPlace = 4;
  std::array<internal::KernelLatticeValues, kSlotsInPlace> in_place;
  std::vector<internal::KernelLatticeValues> on_heap(data.depths > kSlotsInPlace ? data.depths : 0);
  internal::KernelLatticeValues result;
  data.kernel->lattice(program.kernel_program(), LatticeFor(how.offsets),
                       on_heap.empty() ? in_place.data() : on_heap.data(), &result);
  const float error = std::max(result.error, how.least_error);
  LatticeBits inside{};
  for (std::size_t x = 0; x < inside.size(); ++x) {
    const float* const values = result.layer[x].value;
    inside[x] = BitsAbove(values, kIso + error);
    std::uint64_t near = BitsAbove(values, kIso - error) & ~inside[x];
    for (; near != 0; near &= near - 1)
      unsure.Add(kTile * x + static_cast<std::size_t>(std::countr_zero(near)));
  }
  return inside;
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

LatticeBits CompiledField::FindInside(const LatticeBlock& lattice, const ActiveSet& active) const {
  const Program program(*data_, lattice.center, active);
  const Offsets offsets = OffsetsOf(lattice.step);
  LatticePoints points;
  LatticeBits inside{};
  const auto step = static_cast<float>(lattice.step);
  const float thinnest = program.ThinnestWithin(kLatticeReach * step) / step;
  if (thinnest < kThinnest) {
    points.AddAll();
  } else {
    inside = Interpolate(*data_, program, {offsets, LeastErrorFor(thinnest)}, points);
  }
  points.Place(offsets);
  const std::span chosen(points.which.data(), points.count);
  ForTiles(*data_, points.At(lattice.center), program, data_->kernel->values,
           [&](const KernelSamples& result, std::size_t begin, int count) {
             for (int i = 0; i < count; ++i) {
               const std::uint16_t at = chosen[begin + static_cast<std::size_t>(i)];
               inside[at / kTile] |= std::uint64_t{result.value[i] > kIso} << at % kTile;
             }
           });
  return inside;
}

void SignedDistances(const SampleBlock& samples, float limit, std::span<float> distances, Isa isa) {
  const internal::BlockKernel& kernel = internal::KernelFor(isa);
  KernelSamples tile;
  std::array<float, kTile> result;
  for (std::size_t begin = 0; begin < distances.size(); begin += kTile) {
    const std::size_t count = std::min<std::size_t>(kTile, distances.size() - begin);
    LoadColumn(samples.value.subspan(begin, count), tile.value);
    LoadColumn(samples.gradient_x.subspan(begin, count), tile.x);
    LoadColumn(samples.gradient_y.subspan(begin, count), tile.y);
    tile.count = LoadColumn(samples.gradient_z.subspan(begin, count), tile.z);
    kernel.distances(tile, limit, result.data());
    std::copy_n(result.data(), count, distances.data() + begin);
  }
}

}  // namespace lascaux

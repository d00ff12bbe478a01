#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <vector>

#include "block_program.h"

namespace lascaux {
namespace {

using internal::KernelSamples;
using internal::kTile;
using internal::LatticeScheme;

/// How a block is interpolated, by the thinnest radius in there, in steps.
struct Interpolation {
  const LatticeScheme* scheme;
  float least_error;  ///< that it is taken to be off by
};

/// A cylinder's field has a fourth derivative of 18 / radius^4 and a third one of 8 / radius^3, and
/// that is about what polynomials of degree 3 and 2 are off by on one axis; 3 / radius^4 was found
/// where a block's edge touches thin things and no check is near. Null for what is so thin that it
/// may lie unseen between nodes.
std::optional<Interpolation> InterpolationFor(float thinnest) {
  constexpr float kThinnest = 2, kThick = 8;
  if (thinnest < kThinnest) return std::nullopt;
  const float inverse = 1 / thinnest, cube = inverse * inverse * inverse;
  if (thinnest < kThick) return Interpolation{&internal::kCubicScheme, 10 * cube * inverse};
  return Interpolation{&internal::kQuadraticScheme, 15 * cube};
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

/// With steps of length 1.
internal::KernelLattice UnitLattice(const LatticeScheme& scheme) {
  constexpr float kMiddle = 0.5F * (internal::kLatticeSide - 1);
  internal::KernelLattice lattice{};
  lattice.side = scheme.side;
  int count = 0;
  const auto add = [&](float x, float y, float z) {
    internal::KernelPoints& tile = lattice.tiles[count / kTile];
    const int at = count++ % kTile;
    tile.x[at] = x - kMiddle;
    tile.y[at] = y - kMiddle;
    tile.z[at] = z - kMiddle;
    tile.count = at + 1;
  };
  for (int node = 0; node < scheme.points(); ++node) {
    const auto at = [&](int stride) { return scheme.nodes[node / stride % scheme.side]; };
    add(at(scheme.side * scheme.side), at(scheme.side), at(1));
  }
  for (int i = 0; i < scheme.checks; ++i)
    add(scheme.check_at[i][0], scheme.check_at[i][1], scheme.check_at[i][2]);
  lattice.columns.count = kTile;
  for (int i = 0; i < kTile; ++i) {
    lattice.columns.x[i] = static_cast<float>(i / internal::kLatticeSide) - kMiddle;
    lattice.columns.y[i] = static_cast<float>(i % internal::kLatticeSide) - kMiddle;
  }
  return lattice;
}

const internal::KernelLattice& LatticeFor(const LatticeScheme& scheme) {
  static const internal::KernelLattice kCubic = UnitLattice(internal::kCubicScheme),
                                       kQuadratic = UnitLattice(internal::kQuadraticScheme);
  return &scheme == &internal::kCubicScheme ? kCubic : kQuadratic;
}

/// A block's field.
struct BlockField {
  const CompiledField::Data& data;
  const Program& program;
};

/// Which points of a lattice are inside; puts those that are too near to tell into `unsure`.
LatticeBits Interpolate(const BlockField& field, float step, const Interpolation& how,
                        LatticePoints& unsure) {
  const auto& [data, program] = field;
  constexpr std::uint32_t kSlotsInPlace = 4;
  std::array<internal::KernelLatticeValues, kSlotsInPlace> in_place;
  std::vector<internal::KernelLatticeValues> on_heap(data.depths > kSlotsInPlace ? data.depths : 0);
  internal::KernelLatticeSides sides;
  data.kernel->lattice(program.kernel_program(), {&LatticeFor(*how.scheme), step, how.least_error},
                       on_heap.empty() ? in_place.data() : on_heap.data(), &sides);
  for (std::size_t x = 0; x < internal::kLatticeSide; ++x) {
    for (std::uint64_t near = sides.unsure[x]; near != 0; near &= near - 1)
      unsure.Add(kTile * x + static_cast<std::size_t>(std::countr_zero(near)));
  }
  return std::to_array(sides.inside);
}

}  // namespace

LatticeBits CompiledField::FindInside(const LatticeBlock& lattice, const ActiveSet& active) const {
  const Program program(*data_, lattice.center, active);
  const Offsets offsets = OffsetsOf(lattice.step);
  LatticePoints points;
  LatticeBits inside{};
  const auto step = static_cast<float>(lattice.step);
  const float thinnest = program.ThinnestWithin(kLatticeReach * step) / step;
  if (const auto how = InterpolationFor(thinnest)) {
    inside = Interpolate({*data_, program}, step, *how, points);
  } else {
    points.AddAll();
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

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lascaux/field/field.h"

/// @file
/// A field made ready for grids: bounds on balls to find the blocks that hold surface, and
/// single-precision evaluation of whole blocks by vector code.
///
/// How to use it: begin with All() on a large block; BoundOnBall() on the ball around it says
/// whether F can be 1 in there and which primitives matter; go on with the smaller list in the
/// blocks that it is cut into; evaluate what is left.
///
///     CompiledField compiled(field);
///     BallBounds found = compiled.BoundOnBall({center, half_diagonal}, compiled.All());
///     if (found.bounds.upper < kIsoValue) ...       // all outside
///     else if (found.bounds.lower > kIsoValue) ...  // all inside
///     else compiled.EvaluateSamples({center, x, y, z}, found.active, {value, gx, gy, gz});

namespace lascaux {

/// Instruction sets that the block code is built for. On machines other than x86-64 only kBaseline
/// is supported.
enum class Isa : std::uint8_t { kBaseline, kAvx2, kAvx512 };

/// True when this build has code for `isa` and this processor runs it.
bool IsSupported(Isa isa) noexcept;

/// The widest that is supported.
Isa BestIsa() noexcept;

/// "baseline", "avx2" or "avx512".
const char* Name(Isa isa) noexcept;

/// Primitives that matter somewhere: indices into a CompiledField, ascending. Belongs to the field
/// that made it.
struct ActiveSet {
  std::vector<std::uint32_t> primitives;

  bool operator==(const ActiveSet&) const = default;
};

/// A ball in the field's unit.
struct Ball {
  Eigen::Vector3d center;
  double radius = 0;
};

/// lower <= F <= upper.
struct FieldBounds {
  float lower = 0, upper = 0;

  bool operator==(const FieldBounds&) const = default;
};

/// What is known of F on a ball, and the primitives that F depends on there.
struct BallBounds {
  FieldBounds bounds;
  ActiveSet active;
};

/// Eight balls around the middles of a cube's eighths. Ball k is at the upper end along x, y and z
/// where k has the bits 4, 2 and 1.
struct BallsAround {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the cube
  double offset = 0;  ///< of the balls' centres from there, along each axis
  double radius = 0;
  double inner = 0;  ///< radius of smaller balls around the same centres; 0 for none
};

/// What is known of F on each of them, and the primitives that F depends on there.
struct BoundsAround {
  std::array<FieldBounds, 8> bounds;
  std::array<FieldBounds, 8> inner;  ///< on the smaller ones; of those whose larger ones leave open
                                     ///< whether F is 1 there
  std::vector<std::uint32_t> primitives;
  std::vector<std::uint8_t> balls;  ///< where each of them matters, bit k for ball k

  /// Those of one ball. `reuse` as for BoundOnBall().
  ActiveSet Active(std::size_t ball, ActiveSet reuse = {}) const;
};

/// n points: origin + (x[i], y[i], z[i]). The spans have one length; choose an origin near the
/// points (a block's centre), for the offsets are single precision.
struct PointBlock {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::span<const float> x, y, z;
};

/// Where values and gradients go: as many of each as there are points. Spans into the caller's
/// memory, since this is the innermost loop of the rasteriser and its blocks live in place (leaf
/// buffers).
struct SampleBlock {
  std::span<float> value, gradient_x, gradient_y, gradient_z;
};

/// 8 x 8 x 8 points around a centre: center + step * (k - 3.5) along each axis, k = 0 to 7.
struct LatticeBlock {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double step = 0;
};

/// One bit a point: number 8 y + z of word x.
using LatticeBits = std::array<std::uint64_t, 8>;

/// |F in single precision - F in double precision| for F up to 4, at points within 64 radii of
/// their block's origin, except within 2e-4 radii of a tip of radius zero. Above 4 the bound is
/// relative: times F / 4.
inline constexpr double kFloatValueError = 5e-5;

/// The same for the gradient: times radius, that is |grad error| <= kFloatGradientError / smallest
/// radius nearby.
inline constexpr double kFloatGradientError = 5e-4;

/// BoundOnBall's bounds are widened by this share of themselves: more than the single-precision
/// error of both the bounds and the blocks' values.
inline constexpr double kBoundSlack = 1e-3;

/// A field made ready once; immutable, cheap to copy, safe to use from many threads at once.
///
/// Segments are split by PreSplit() first. Same input, same bits, whatever the number of points in
/// a block and their order; a different Isa may differ within kFloatValueError.
class CompiledField {
 public:
  struct Data;

  /// `field` must be valid: Validate(field) has no error. `isa` must be supported.
  explicit CompiledField(const Field& field, Isa isa = BestIsa());

  /// All primitives.
  ActiveSet All() const;

  /// Bounds of F on the ball, and the shrunk list: F restricted to `active` equals F restricted to
  /// `in` at every point of the ball. `in` must hold all that matters on the ball: All(), or the
  /// list of a ball around it.
  ///
  /// Rigorous, not sampled: each primitive's kernel is replaced by a polynomial that dominates it
  /// for every point of the ball and integrated exactly, Ricci blends and max are monotone. A ball
  /// whose upper bound is below 1 holds no surface. About 20 ns a primitive and 0.1 us a call.
  /// `reuse` is storage of an old list to save an allocation: std::move it in.
  BallBounds BoundOnBall(const Ball& ball, const ActiveSet& in, ActiveSet reuse = {}) const;

  /// The same for eight balls at a time, in the time of two. `reuse` is storage of old lists.
  BoundsAround BoundOnBalls(const BallsAround& balls, const ActiveSet& in,
                            BoundsAround reuse = {}) const;

  /// F at each point. `values` has as many elements as there are points.
  void EvaluateValues(const PointBlock& points, const ActiveSet& active,
                      std::span<float> values) const;

  /// Which points of a lattice have F > 1, as EvaluateValues() tells them.
  ///
  /// Where no primitive is thinner than two steps, most of it is interpolated: each chain's field
  /// by polynomials of degree 3 from 64 points, or of degree 2 from 27 where none is thinner than
  /// eight; blends and gain are evaluated at each point. How much that is off by is seen at 32 or
  /// 21 points more, and whatever is not further from 1 than some times that is evaluated. Four to
  /// seven times as fast as EvaluateValues() at all points.
  LatticeBits FindInside(const LatticeBlock& lattice, const ActiveSet& active) const;

  /// F and its gradient at each point.
  void EvaluateSamples(const PointBlock& points, const ActiveSet& active,
                       const SampleBlock& samples) const;

  /// Least radius among the primitives, in the direction in which their part is thinnest; +infinity
  /// for none.
  double ThinnestRadius(const ActiveSet& active) const;

  /// Box outside of which F is 0; empty for a field without primitives.
  const Eigen::AlignedBox3d& bounds() const noexcept;

  Isa isa() const noexcept;

 private:
  std::shared_ptr<const Data> data_;
};

/// SignedDistance() of each sample in single precision, within 1e-5 / |grad psi| of it (about 1e-5
/// local radii); clamped to [-limit, limit].
///
/// `distances` has as many elements as there are samples.
void SignedDistances(const SampleBlock& samples, float limit, std::span<float> distances,
                     Isa isa = BestIsa());

}  // namespace lascaux

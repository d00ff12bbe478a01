#include "ball_bounds.h"

#include <cmath>

namespace lascaux::internal {
namespace {

/// Bounds of a field times its gain, whose logarithm is in a range.
FieldBounds Times(const FieldBounds& bounds, const SplineTable::Extent& gain) {
  return {bounds.lower * std::exp(gain.low[0]), bounds.upper * std::exp(gain.high[0])};
}

}  // namespace

Range RangeOfPoint(const CompiledPrimitive& point, double distance, double radius) {
  const auto kernel = [&](double r) {
    const double w = r / point.radius;
    const double p = std::max(1 - w * w / 4, 0.0);
    return point.norm * p * p * p;
  };
  return {kernel(distance + radius), kernel(std::max(distance - radius, 0.0))};
}

/// The smaller of two. What the map shifts and stretches by anywhere on the ball is known, which is
/// close for large balls; and how fast that changes, which is close for small ones.
Ball FlattenBall(const CompiledPart& part, const Ball& ball) {
  const Eigen::Vector2d place = ball.center.head<2>(),
                        reach = Eigen::Vector2d::Constant(ball.radius);
  const auto map =
      part.table->BoundsOn({Eigen::Vector2d(place - reach), Eigen::Vector2d(place + reach)});
  const auto middle_low = static_cast<double>(map.extent.low[0]),
             middle_high = static_cast<double>(map.extent.high[0]),
             steepest = static_cast<double>(map.extent.high[1]);
  const double middle = (middle_low + middle_high) / 2;
  const double steepness = (static_cast<double>(map.extent.low[1]) + steepest) / 2;
  const double off = ball.center.z() - middle;
  const double by_extent = ball.radius * std::max(1.0, steepest) +
                           steepest * (middle_high - middle) +
                           (steepest - steepness) * std::abs(off);

  // z in the flat space changes by at most `steepest` along z and by `across` in the plane, so
  // offsets are stretched by no more than the matrix (1 0; across steepest) does.
  const double farthest = std::abs(off) + (middle_high - middle) + ball.radius;
  const double across =
      steepest * static_cast<double>(map.slope[0]) + farthest * static_cast<double>(map.slope[1]);
  const double squares = 1 + across * across + steepest * steepest;
  const double stretch =
      std::sqrt((squares + std::sqrt(squares * squares - 4 * steepest * steepest)) / 2);
  if (stretch * ball.radius < by_extent) return {Flatten(part, ball.center), stretch * ball.radius};
  return {{place.x(), place.y(), part.z0 + off * steepness}, by_extent};
}

/// Closer knowledge of the gain is asked for only where it could tell on which side of the surface
/// the ball is.
FieldBounds Amplified(const FieldBounds& bounds, const Ball& ball,
                      const CompiledField::Data& data) {
  if (!data.gain) return bounds;
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(ball.radius),
                        center = ball.center.head<2>();
  const Eigen::AlignedBox2d box(Eigen::Vector2d(center - reach), Eigen::Vector2d(center + reach));
  const auto rough = data.gain->RoughExtentOn(box);
  constexpr auto kSurface = static_cast<float>(kIsoValue);
  const FieldBounds found = Times(bounds, rough);
  const bool is_told = found.lower > kSurface || found.upper < kSurface;
  const bool is_open = bounds.lower * std::exp(rough.high[0]) <= kSurface &&
                       bounds.upper * std::exp(rough.low[0]) >= kSurface;
  return is_told || is_open ? found : Times(bounds, data.gain->ExtentOn(box, *data.kernel));
}

}  // namespace lascaux::internal

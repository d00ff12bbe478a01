#include "lascaux/sketch/bezier.h"

#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Wang's bound grows with the curve; a drawing's curve that needs more samples than this is not a
/// drawing's curve.
constexpr int kMaxFlattenSteps = 4095;

Vector2d Lerp(const Vector2d& a, const Vector2d& b, double t) { return a + t * (b - a); }

/// Unit vector from `from` to the first of `to` that lies elsewhere.
template <typename... Points>
Vector2d DirectionToFirstOther(const Vector2d& from, const Points&... to) {
  Vector2d direction = Vector2d::Zero();
  ((direction.isZero(0) && (direction = to - from, true)), ...);
  return direction.isZero(0) ? direction : direction.stableNormalized();
}

/// Parameters in (0, 1) at which one coordinate of the derivative vanishes; n values are written to
/// `roots`.
int ExtremeParameters(const CubicBezier& curve, int axis, double roots[2]) {
  const double a = curve.p[1][axis] - curve.p[0][axis];
  const double b = curve.p[2][axis] - curve.p[1][axis];
  const double c = curve.p[3][axis] - curve.p[2][axis];
  const double quadratic = a - 2 * b + c, linear = 2 * (b - a);
  int n = 0;
  const auto add = [&](double t) {
    if (t > 0 && t < 1) roots[n++] = t;
  };
  const double discriminant = linear * linear - 4 * quadratic * a;
  if (discriminant < 0) return 0;
  // The numerically stable pair of roots; covers quadratic == 0 through the second one.
  const double q = -0.5 * (linear + std::copysign(std::sqrt(discriminant), linear));
  if (quadratic != 0) add(q / quadratic);
  if (q != 0) add(a / q);
  return n;
}

}  // namespace

Vector2d CubicBezier::At(double t) const {
  const double u = 1 - t;
  return u * u * u * p[0] + 3 * u * u * t * p[1] + 3 * u * t * t * p[2] + t * t * t * p[3];
}

Vector2d CubicBezier::Derivative(double t) const {
  const double u = 1 - t;
  return 3 * (u * u * (p[1] - p[0]) + 2 * u * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
}

Vector2d CubicBezier::SecondDerivative(double t) const {
  return 6 * ((1 - t) * (p[2] - 2 * p[1] + p[0]) + t * (p[3] - 2 * p[2] + p[1]));
}

Vector2d CubicBezier::StartTangent() const { return DirectionToFirstOther(p[0], p[1], p[2], p[3]); }

Vector2d CubicBezier::EndTangent() const { return -DirectionToFirstOther(p[3], p[2], p[1], p[0]); }

CubicBezier Line(const Vector2d& a, const Vector2d& b) {
  return {{a, Lerp(a, b, 1.0 / 3), Lerp(a, b, 2.0 / 3), b}};
}

CubicBezier Reversed(const CubicBezier& curve) {
  return {{curve.p[3], curve.p[2], curve.p[1], curve.p[0]}};
}

std::pair<CubicBezier, CubicBezier> Split(const CubicBezier& curve, double t) {
  const auto& p = curve.p;
  const Vector2d a = Lerp(p[0], p[1], t), b = Lerp(p[1], p[2], t), c = Lerp(p[2], p[3], t);
  const Vector2d d = Lerp(a, b, t), e = Lerp(b, c, t), f = Lerp(d, e, t);
  return {{{p[0], a, d, f}}, {{f, e, c, p[3]}}};
}

Eigen::AlignedBox2d Bounds(const CubicBezier& curve) {
  Eigen::AlignedBox2d box(curve.p[0]);
  box.extend(curve.p[3]);
  for (int axis = 0; axis < 2; ++axis) {
    double roots[2];
    const int n = ExtremeParameters(curve, axis, roots);
    for (int i = 0; i < n; ++i) box.extend(curve.At(roots[i]));
  }
  return box;
}

std::vector<CurveSample> Flatten(const CubicBezier& curve, double tolerance) {
  const auto& p = curve.p;
  const double bend = std::max((p[2] - 2 * p[1] + p[0]).norm(), (p[3] - 2 * p[2] + p[1]).norm());
  const double wanted = std::ceil(std::sqrt(0.75 * bend / tolerance));
  const int steps = static_cast<int>(std::clamp(wanted, 1.0, double{kMaxFlattenSteps}));
  std::vector<CurveSample> samples;
  samples.reserve(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    samples.push_back({curve.At(t), t});
  }
  samples.push_back({p[3], 1.0});
  return samples;
}

}  // namespace lascaux

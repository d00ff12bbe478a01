#include "sketch/parts/completion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lascaux/sketch/parts.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Handle lengths in chords, a geometric ladder over the paper's range 0.1 to 1.
constexpr std::array<double, 6> kHandles{0.1, 0.2, 0.33, 0.5, 0.7, 1.0};
constexpr int kEnergySamples = 24;
constexpr int kPolylineSamples = 48;

CubicBezier Curve(const CompletionEnd& from, const CompletionEnd& to, double a, double b) {
  return {{from.point, from.point + a * from.direction, to.point + b * to.direction, to.point}};
}

Polyline Sampled(const CubicBezier& curve) {
  Polyline line;
  for (int i = 0; i <= kPolylineSamples; ++i)
    Append(line, {curve.At(static_cast<double>(i) / kPolylineSamples)});
  return line;
}

/// True when the inner points of `line` lie inside the ring.
bool IsInside(const Polyline& line, const Polyline& ring) {
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    if (!Contains(ring, line[i])) return false;
  }
  return true;
}

}  // namespace

double CurvatureVariation(const CubicBezier& curve) {
  double length = 0, variation = 0, before = 0;
  Vector2d last = curve.p[0];
  for (int i = 0; i <= kEnergySamples; ++i) {
    const double t = static_cast<double>(i) / kEnergySamples;
    const Vector2d d = curve.Derivative(t), dd = curve.SecondDerivative(t), p = curve.At(t);
    const double speed = d.norm();
    const double curvature = speed > 0 ? std::abs(Cross(d, dd)) / (speed * speed * speed) : 0;
    if (i > 0) variation += std::abs(curvature - before);
    before = curvature;
    length += (p - last).norm();
    last = p;
  }
  return length * variation;
}

Completion Complete(const CompletionEnd& from, const CompletionEnd& to) {
  const double chord = (to.point - from.point).norm();
  Completion best{Curve(from, to, 0, 0), std::numeric_limits<double>::infinity()};
  for (const double a : kHandles) {
    for (const double b : kHandles) {
      const CubicBezier curve = Curve(from, to, a * chord, b * chord);
      const double energy = CurvatureVariation(curve);
      if (energy < best.energy) best = {curve, energy};
    }
  }
  return best;
}

Polyline CompleteInside(const CompletionEnd& from, const CompletionEnd& to, const Polyline& ring) {
  const CubicBezier best = Complete(from, to).curve;
  const double a = (best.p[1] - best.p[0]).norm(), b = (best.p[2] - best.p[3]).norm();
  for (double share = 1; share > 0.05; share *= 0.7) {
    Polyline line = Sampled(Curve(from, to, share * a, share * b));
    if (IsInside(line, ring)) return line;
  }
  return {from.point, to.point};
}

}  // namespace lascaux

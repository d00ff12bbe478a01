#include "lascaux/field/triangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace lascaux {
namespace {

using Eigen::Vector3d;

/// 1 / (pi (3/4)^4): an infinite sheet is 1 at its radius.
constexpr double kNorm = 256.0 / (81 * std::numbers::pi);
/// Gauss-Legendre on [-1, 1], 12 nodes, the positive half.
constexpr std::array<double, 6> kNodes = {0.1252334085114689, 0.3678314989981802,
                                          0.5873179542866175, 0.7699026741943047,
                                          0.9041172563704749, 0.9815606342467193};
constexpr std::array<double, 6> kWeights = {0.2491470458134028, 0.2334925365383548,
                                            0.2031674267230659, 0.1600783285433462,
                                            0.1069393259953184, 0.0471753363865118};
/// Largest ratio of the radii of a piece that the nodes are exact for.
constexpr double kPieceRatio = 3;
/// Radii below this share of the largest are taken for it: y stays finite.
constexpr double kLeastRadius = 1e-6;
/// Slopes that change the radius by less than this share over the triangle are none.
constexpr double kNoSlope = 1e-13;

/// A line in the plane of the triangle: v = at + slope s.
struct Line {
  double at = 0, slope = 0;
};

/// Between two corners along s, from one bounding line to another.
struct Half {
  double from = 0, to = 0;  ///< s
  std::array<Line, 2> sides;
};

/// The triangle in its own coordinates: s from its largest radius (its first corner) down the slope
/// of the radius, v along lines of one radius, and the normal.
struct Frame {
  Vector3d origin, down, across, normal;
  double radius = 1, slope = 0;  ///< at s = 0, and its change by s, <= 0
  std::array<Half, 2> halves;
};

/// None for a triangle that contributes nothing.
std::optional<Frame> FrameOf(const Triangle& triangle) {
  const auto& p = triangle.corners;
  const auto& r = triangle.radii;
  const Vector3d area = (p[1] - p[0]).cross(p[2] - p[0]);
  const double twice = area.norm();
  if (!(twice > 0) || !(*std::max_element(r.begin(), r.end()) > 0)) return std::nullopt;
  Frame frame;
  frame.normal = area / twice;
  std::array<Vector3d, 3> edges;  // opposite to each corner
  std::size_t longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    edges[i] = p[(i + 2) % 3] - p[(i + 1) % 3];
    if (edges[i].squaredNorm() > edges[longest].squaredNorm()) longest = i;
  }
  const Vector3d gradient =
      frame.normal.cross(r[0] * edges[0] + r[1] * edges[1] + r[2] * edges[2]) / twice;
  const double largest = *std::max_element(r.begin(), r.end());
  const double slope = gradient.norm();
  const bool sloped = slope * edges[longest].norm() > kNoSlope * largest;
  // Without a slope one height of the triangle is as good as another.
  frame.down = sloped ? Vector3d(-gradient / slope)
                      : Vector3d(-frame.normal.cross(edges[longest]).normalized());
  frame.slope = sloped ? -slope : 0;
  frame.across = frame.normal.cross(frame.down);
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return p[a].dot(frame.down) < p[b].dot(frame.down);
  });
  frame.origin = p[order[0]];
  frame.radius = sloped ? r[order[0]] : largest;
  std::array<double, 3> s, v;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d way = p[order[i]] - frame.origin;
    s[i] = way.dot(frame.down), v[i] = way.dot(frame.across);
  }
  const auto line = [&](std::size_t a, std::size_t b) {
    const double by = s[b] > s[a] ? (v[b] - v[a]) / (s[b] - s[a]) : 0;
    return Line{v[a] - by * s[a], by};
  };
  const Line whole = line(0, 2);
  frame.halves[0] = {s[0], s[1], {whole, line(0, 1)}};
  frame.halves[1] = {s[1], s[2], {whole, line(1, 2)}};
  if (v[1] < whole.at + whole.slope * s[1]) {
    for (Half& half : frame.halves) std::swap(half.sides[0], half.sides[1]);
  }
  return frame;
}

/// A point seen from the triangle, in its largest radii, and the kernel on the line through its
/// foot: P(y) = top cos^2(theta) with y = middle + reach sin(theta). (The names of scalis.)
struct View {
  double x = 0, v = 0, h = 0;
  double slope = 0;
  double middle = 0, reach = 0, top = 0;

  View(const Frame& frame, const Vector3d& point) : slope(frame.slope) {
    const Vector3d way = (point - frame.origin) / frame.radius;
    x = way.dot(frame.down), v = way.dot(frame.across), h = way.dot(frame.normal);
    const double e = 1 + slope * x;
    const double squares = std::max(e * e + slope * slope * h * h, 1e-30);
    const double rest = std::max(4 * squares - h * h, 0.0);
    middle = (x * e + slope * h * h) / squares;
    reach = std::sqrt(rest) / squares;
    top = rest / (4 * squares);
  }
  /// Largest radius over that at y.
  double Shrink(double y) const { return 1 - slope * y; }
};

/// A bounding line as (v - v of the point) / radius: at + by y.
struct Side {
  double at = 0, by = 0;

  Side(const Line& line, double radius, const View& view) : at(line.at / radius - view.v) {
    by = line.slope - view.slope * at;
  }
};

/// Angles between which the integrand is analytic and short enough for the nodes, ascending.
class Breaks {
 public:
  Breaks(const View& view, double from, double to) : view_(view) {
    from_ = AngleOf(from), to_ = AngleOf(to);
    if (!(from_ < to_)) return;
    Add(from_), Add(to_), Add(0);
    const double first = view.Shrink(YOf(from_)), last = view.Shrink(YOf(to_));
    if (!(view.slope < 0)) return;
    for (double shrink = first * kPieceRatio; shrink < last; shrink *= kPieceRatio) {
      Add(AngleOf((1 - shrink) / view.slope));
    }
  }

  /// Where the side leaves or enters the kernel's support.
  void Cut(const Side& side) {
    const double a = side.at + side.by * view_.middle, b = side.by * view_.reach;
    // (a + b u)^2 = 4 top (1 - u^2)
    const double qa = b * b + 4 * view_.top, qb = a * b, qc = a * a - 4 * view_.top;
    const double discriminant = qb * qb - qa * qc;
    if (!(discriminant > 0)) return;
    const double q = -(qb + std::copysign(std::sqrt(discriminant), qb));
    AddSine(q / qa);
    if (q != 0) AddSine(qc / q);
  }

  std::span<const double> Sorted() {
    std::sort(angles_.begin(), angles_.begin() + static_cast<std::ptrdiff_t>(count_));
    return std::span(angles_).first(count_);
  }

 private:
  double YOf(double angle) const { return view_.middle + view_.reach * std::sin(angle); }
  double AngleOf(double y) const {
    return view_.reach > 0 ? std::asin(std::clamp((y - view_.middle) / view_.reach, -1.0, 1.0)) : 0;
  }
  void AddSine(double sine) {
    if (sine > -1 && sine < 1) Add(std::asin(sine));
  }
  void Add(double angle) {
    if (angle >= from_ && angle <= to_ && count_ < angles_.size()) angles_[count_++] = angle;
  }

  const View& view_;
  double from_ = 0, to_ = 0;
  /// Ends, the middle, two roots a side, and the ratios of three down to kLeastRadius.
  std::array<double, 24> angles_{};
  std::size_t count_ = 0;
};

/// Integrals over v of powers of the kernel c - w^2 / 4, and of w times its square, up to w.
struct Strip {
  double cubes = 0, squares = 0, moments = 0;

  Strip(double c, double w) {
    const double w2 = w * w, k = c - w2 / 4;
    cubes = w * (c * c * c - w2 * (c * c / 4 - w2 * (3 * c / 80 - w2 / 448)));
    squares = w * (c * c - w2 * (c / 6 - w2 / 80));
    moments = -2.0 / 3 * k * k * k;
  }
};

/// Sums over one half; the gradient by (down, across, normal), without its factor.
struct Sums {
  double value = 0, down = 0, across = 0, normal = 0;

  Sums& operator+=(const Sums& other) {
    value += other.value, down += other.down, across += other.across, normal += other.normal;
    return *this;
  }
};

Sums Integrate(const View& view, const std::array<Side, 2>& sides, double from, double to) {
  Sums sums;
  const double half = (to - from) / 2, middle = (from + to) / 2;
  for (std::size_t i = 0; i < 2 * kNodes.size(); ++i) {
    const double node = i % 2 == 0 ? kNodes[i / 2] : -kNodes[i / 2];
    const double angle = middle + half * node, cosine = std::cos(angle);
    const double y = view.middle + view.reach * std::sin(angle);
    const double c = view.top * cosine * cosine, most = 2 * std::sqrt(c);
    const Strip low(c, std::clamp(sides[0].at + sides[0].by * y, -most, most));
    const Strip high(c, std::clamp(sides[1].at + sides[1].by * y, -most, most));
    const double weight = kWeights[i / 2] * half * view.reach * cosine;  // of dy
    const double shrink = view.Shrink(y), squares = weight * (high.squares - low.squares);
    sums.value += weight / shrink * (high.cubes - low.cubes);
    sums.down += (view.x * shrink - y) * squares;
    sums.normal += view.h * shrink * squares;
    sums.across -= weight * (high.moments - low.moments);
  }
  return sums;
}

}  // namespace

FieldSample Evaluate(const Triangle& triangle, const Vector3d& point) {
  const std::optional<Frame> made = FrameOf(triangle);
  if (!made) return {};
  const Frame& frame = *made;
  const View view(frame, point);
  if (!(view.reach > 0)) return {};
  Sums sums;
  const auto y_of = [&](double s) {
    const double way = s / frame.radius;
    return way / std::max(1 + frame.slope * way, kLeastRadius);
  };
  for (const Half& half : frame.halves) {
    if (!(half.from < half.to)) continue;
    const std::array<Side, 2> sides = {Side(half.sides[0], frame.radius, view),
                                       Side(half.sides[1], frame.radius, view)};
    Breaks breaks(view, y_of(half.from), y_of(half.to));
    for (const Side& side : sides) breaks.Cut(side);
    const std::span<const double> angles = breaks.Sorted();
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      if (angles[i] < angles[i + 1]) sums += Integrate(view, sides, angles[i], angles[i + 1]);
    }
  }
  const double factor = -1.5 * kNorm / frame.radius;
  return {
      kNorm * std::max(sums.value, 0.0),
      factor * (sums.down * frame.down + sums.across * frame.across + sums.normal * frame.normal)};
}

Eigen::AlignedBox3d Bounds(const Triangle& triangle) {
  Eigen::AlignedBox3d box;
  if (!FrameOf(triangle)) return box;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d reach = Vector3d::Constant(kSupportRadii * triangle.radii[i]);
    box.extend(Vector3d(triangle.corners[i] - reach));
    box.extend(Vector3d(triangle.corners[i] + reach));
  }
  return box;
}

}  // namespace lascaux

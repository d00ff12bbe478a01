#include "skeleton/planar_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lascaux/field/primitives.h"
#include "skeleton/chains.h"
#include "skeleton/index.h"

namespace lascaux {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Normalisation of points and curves for the kernel (1 - r^2 / 4)^3: f = 1 at one radius.
constexpr double kPointNorm = 64.0 / 27.0;
constexpr double kCurveNorm = 1.4968340312374837;  // 1 / (2 (3/4)^(7/2) 32/35)
/// Pieces with |kappa| up to this have radii in a ratio of at most 3.
constexpr double kGentle = 0.5;
constexpr int kMaxPieces = 16;

/// Nodes and weights of Gauss-Legendre on [-1, 1].
using Nodes = Eigen::Array<double, 8, 1>;
const Nodes kNodes{-0.9602898564975363, -0.7966664774136267, -0.5255324099163290,
                   -0.1834346424956498, 0.1834346424956498,  0.5255324099163290,
                   0.7966664774136267,  0.9602898564975363};
const Nodes kWeights{0.1012285362903763, 0.2223810344533745, 0.3137066458778873,
                     0.3626837833783620, 0.3626837833783620, 0.3137066458778873,
                     0.2223810344533745, 0.1012285362903763};

/// A segment's integral with its derivatives by its ends; `a` is the end of the larger radius.
struct SegmentSample {
  double value = 0;
  Vector2d by_a = Vector2d::Zero(), by_b = Vector2d::Zero();
  double by_radius_a = 0, by_radius_b = 0;
};

struct Disc {
  Vector2d position;
  double radius;
};

/// In the homothetic parameter y = s / radius(s), s measured from `a`: radius = radius_a / (1 - g
/// y) and the kernel is (top - curve (y - middle)^2)^3, on one interval for every slope g <= 0.
SegmentSample SampleSegment(const Disc& a, const Disc& b, const Vector2d& point) {
  SegmentSample sample;
  const Vector2d axis = b.position - a.position;
  const double length = axis.norm();
  if (!(length > 0)) return sample;
  const Vector2d u = axis / length;
  const double g = (b.radius - a.radius) / length;
  const Vector2d w = (point - a.position) / a.radius;
  const double x = w.dot(u);
  const Vector2d across = w - x * u;
  const double h2 = across.squaredNorm();
  const double e = 1 + g * x, big = std::max(e * e + g * g * h2, 1e-30);
  const double room = 4 * big - h2;
  if (room <= 0) return sample;
  const double half = std::sqrt(room) / big, middle = (x * e + g * h2) / big;
  const double top = room / (4 * big), curve = big / 4;
  const double y1 = std::max(0.0, middle - half), y2 = std::min(length / b.radius, middle + half);
  if (y1 >= y2) return sample;

  const double kappa = std::abs(g) * (y2 - y1) / 2 / (1 - g * (y1 + y2) / 2);
  // The first of n equal pieces is the steepest: its kappa is at most K / (n (1 - K) + K) for K of
  // the whole.
  const double needed = kappa > kGentle ? kappa / (1 - kappa) * (1 / kGentle - 1) : 1;
  const int pieces = std::clamp(static_cast<int>(std::ceil(needed)), 1, kMaxPieces);
  const double step = (y2 - y1) / pieces;
  // Of what pulls the ends: what is along w, and along u.
  double w_a = 0, w_b = 0, u_a = 0, u_b = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const Nodes y = y1 + (piece + 0.5) * step + step / 2 * kNodes;
    const Nodes narrow = 1 - g * y;  // radius_a over the radius here
    const Nodes s = y / narrow;      // arc length in radius_a
    const Nodes p = top - curve * (y - middle).square();
    const Nodes p2 = p.square(), p3 = p2 * p;
    const Nodes measure = step / 2 * kWeights / narrow;
    const Nodes t = a.radius / length * s;
    sample.value += (measure * p3).sum();
    const Nodes narrowed = measure * narrow / a.radius;
    const Nodes by_radius = narrowed * (6 * p2 - 7 * p3);
    const double by_both = by_radius.sum(), by_b = (t * by_radius).sum();
    sample.by_radius_a += by_both - by_b;
    sample.by_radius_b += by_b;
    const Nodes toward = narrowed * narrow * p2, toward_b = t * toward;
    const double w_both = toward.sum(), w_one = toward_b.sum();
    const double u_both = (toward * s).sum(), u_one = (toward_b * s).sum();
    w_a += w_both - w_one;
    w_b += w_one;
    u_a += u_both - u_one;
    u_b += u_one;
  }
  const Vector2d pull_a = w_a * w - u_a * u, pull_b = w_b * w - u_b * u;
  sample.value *= kCurveNorm;
  sample.by_radius_a *= kCurveNorm;
  sample.by_radius_b *= kCurveNorm;
  sample.by_a = 1.5 * kCurveNorm * pull_a - (sample.value / length) * u;
  sample.by_b = 1.5 * kCurveNorm * pull_b + (sample.value / length) * u;
  return sample;
}

struct PointSample {
  double value = 0, by_radius = 0;
  Vector2d by_center = Vector2d::Zero();
};

PointSample SamplePoint(const Disc& disc, double weight, const Vector2d& point) {
  const Vector2d d = (point - disc.position) / disc.radius;
  const double h2 = d.squaredNorm(), k = 1 - h2 / 4;
  if (k <= 0) return {};
  const double norm = weight * kPointNorm, slope = 1.5 * norm * k * k / disc.radius;
  return {norm * k * k * k, slope * h2, slope * d};
}

/// Ricci's exponent between the chains of a part is MakeField()'s, 4: a value's share in the sum,
/// and the derivative of the blend by it.
double ShareOf(double ratio) { return ratio * ratio * ratio * ratio; }
double SlopeOf(double ratio) { return ratio * ratio * ratio; }

}  // namespace

PlanarField::PlanarField(const std::vector<Chain>& chains) {
  int first = 0;
  for (const Chain& chain : chains) {
    Polyline line;
    line.first = first;
    for (const SkeletonVertex& v : chain.vertices) {
      line.positions.push_back(v.position);
      line.radii.push_back(v.radius);
    }
    const int n = static_cast<int>(chain.vertices.size());
    first += n;
    for (int i = 0; n > 1 && i < n; i += n - 1) {
      End end;
      end.vertex = i;
      end.neighbour = i == 0 ? 1 : i - 1;
      end.direction = EndDirection(chain, static_cast<std::size_t>(i));
      const double length =
          (chain.vertices[Index(i)].position - chain.vertices[Index(end.neighbour)].position)
              .norm();
      const double shift = kCapShift * line.radii[Index(i)];
      if (length > 0) {
        end.turn =
            shift / length * (Matrix2d::Identity() - end.direction * end.direction.transpose());
      }
      line.positions[Index(i)] += shift * end.direction;
      line.ends.push_back(end);
    }
    for (const Vector2d& p : line.positions) line.center += p / n;
    for (int i = 0; i < n; ++i) {
      line.reach = std::max(line.reach, (line.positions[Index(i)] - line.center).norm() +
                                            kSupportRadii * line.radii[Index(i)]);
    }
    for (int i = 0; i + 1 < n; ++i) {
      const double reach = kSupportRadii * std::max(line.radii[Index(i)], line.radii[Index(i + 1)]);
      Eigen::AlignedBox2d box(line.positions[Index(i)]);
      box.extend(line.positions[Index(i + 1)]);
      box.min().array() -= reach;
      box.max().array() += reach;
      line.boxes.push_back(box);
    }
    pulls_.resize(std::max(pulls_.size(), line.positions.size()));
    lines_.push_back(std::move(line));
  }
}

double PlanarField::AddPolyline(const Polyline& line, const Vector2d& point, PlanarSample& sample) {
  const int n = static_cast<int>(line.positions.size());
  int first = n, last = -1;  // of the vertices that may pull
  const auto touch = [&](int vertex) {
    first = std::min(first, vertex);
    last = std::max(last, vertex);
  };
  double value = 0;
  const auto add_point = [&](int vertex, double share, double weight) {
    const PointSample s = SamplePoint(
        {line.positions[Index(vertex)], share * line.radii[Index(vertex)]}, weight, point);
    if (!(s.value > 0)) return;
    touch(vertex);
    value += s.value;
    pulls_[Index(vertex)].position += s.by_center;
    pulls_[Index(vertex)].radius += share * s.by_radius;
  };
  if (n == 1) add_point(0, 1, 1);
  for (const End& end : line.ends) add_point(end.vertex, kCapRadius, kCapWeight);
  for (int i = 0; i + 1 < n; ++i) {
    if (!line.boxes[Index(i)].contains(point)) continue;
    touch(i);
    touch(i + 1);
    const int a = line.radii[Index(i)] >= line.radii[Index(i + 1)] ? i : i + 1, b = 2 * i + 1 - a;
    const SegmentSample s = SampleSegment({line.positions[Index(a)], line.radii[Index(a)]},
                                          {line.positions[Index(b)], line.radii[Index(b)]}, point);
    value += s.value;
    pulls_[Index(a)].position += s.by_a;
    pulls_[Index(a)].radius += s.by_radius_a;
    pulls_[Index(b)].position += s.by_b;
    pulls_[Index(b)].radius += s.by_radius_b;
  }
  Vector2d gradient = Vector2d::Zero();
  for (int i = first; i <= last; ++i) gradient -= pulls_[Index(i)].position;
  values_.push_back(value);
  gradients_.push_back(gradient);
  // Where an end is moved out by its radius along its segment, its pull is felt by radius and
  // neighbour too.
  std::vector<Pull>& pulls = pulls_;
  std::array<std::pair<int, Vector2d>, 2> passed_on;
  std::size_t count = 0;
  for (const End& end : line.ends) {
    if (end.vertex < first || end.vertex > last) continue;
    touch(end.neighbour);
    Pull& pull = pulls[Index(end.vertex)];
    const Vector2d turned = end.turn * pull.position;
    pull.radius += kCapShift * end.direction.dot(pull.position);
    pull.position += turned;
    passed_on[count++] = {end.neighbour, -turned};
  }
  for (std::size_t k = 0; k < count; ++k)
    pulls[Index(passed_on[k].first)].position += passed_on[k].second;
  for (int i = first; i <= last; ++i) {
    const Pull pull = std::exchange(pulls[Index(i)], {});
    if (pull.radius == 0 && pull.position.isZero(0)) continue;
    const int index = 3 * (line.first + i);
    sample.derivatives.emplace_back(index, pull.radius * line.radii[Index(i)]);
    sample.derivatives.emplace_back(index + 1, pull.position.x());
    sample.derivatives.emplace_back(index + 2, pull.position.y());
  }
  return value;
}

void PlanarField::Evaluate(const Vector2d& point, PlanarSample& sample) {
  sample.value = 0;
  sample.gradient.setZero();
  sample.derivatives.clear();
  values_.clear();
  gradients_.clear();
  row_ends_.clear();
  double largest = 0;
  for (const Polyline& line : lines_) {
    if ((point - line.center).squaredNorm() >= line.reach * line.reach) continue;
    largest = std::max(largest, AddPolyline(line, point, sample));
    row_ends_.push_back(sample.derivatives.size());
  }
  if (largest <= 0) return;
  double sum = 0;
  for (const double v : values_) sum += ShareOf(v / largest);
  sample.value = largest * std::sqrt(std::sqrt(sum));
  for (std::size_t c = 0, k = 0; c < values_.size(); ++c) {
    const double share = SlopeOf(values_[c] / sample.value);
    sample.gradient += share * gradients_[c];
    for (; k < row_ends_[c]; ++k) sample.derivatives[k].second *= share;
  }
}

}  // namespace lascaux

#include "skeleton/planar_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
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

struct PointSample {
  double value = 0, by_radius = 0;
  Vector2d by_center = Vector2d::Zero();
};

PointSample SamplePoint(const SkeletonVertex& disc, double weight, const Vector2d& point) {
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
      line.boxes.Add(box);
      const int a = line.radii[Index(i)] >= line.radii[Index(i + 1)] ? i : i + 1, b = 2 * i + 1 - a;
      LaneSegment& segment = line.segments.emplace_back(
          SkeletonVertex{line.positions[Index(a)], line.radii[Index(a)]},
          SkeletonVertex{line.positions[Index(b)], line.radii[Index(b)]});
      segment.a = a, segment.b = b;
    }
    pulls_.resize(std::max(pulls_.size(), line.positions.size()));
    lines_.push_back(std::move(line));
  }
}

void PlanarField::AddSegments(const Polyline& line, const Vector2d& point, double& value) {
  for (std::size_t first = 0; first < near_.size(); first += 4) {
    const std::size_t count = std::min<std::size_t>(4, near_.size() - first);
    std::array<const LaneSegment*, 4> four{};
    for (std::size_t k = 0; k < count; ++k) four[k] = &line.segments[Index(near_[first + k])];
    const LaneSamples s = SampleSegments(std::span(four).first(count), point);
    for (std::size_t k = 0; k < count; ++k) {
      value += s.value[k];
      Pull& a = pulls_[Index(four[k]->a)];
      Pull& b = pulls_[Index(four[k]->b)];
      a.position += Vector2d(s.by_ax[k], s.by_ay[k]);
      a.radius += s.by_radius_a[k];
      b.position += Vector2d(s.by_bx[k], s.by_by[k]);
      b.radius += s.by_radius_b[k];
    }
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
  near_.clear();
  FindContaining(line.boxes, point, near_);
  if (!near_.empty()) touch(near_.front()), touch(near_.back() + 1);
  AddSegments(line, point, value);
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
    sample.derivatives.push_back(pull.radius * line.radii[Index(i)]);
    sample.derivatives.push_back(pull.position.x());
    sample.derivatives.push_back(pull.position.y());
  }
  const PlanarSample::Run& run =
      sample.runs.emplace_back(3 * (line.first + first), 3 * std::max(last - first + 1, 0));
  sample.derivatives.resize(sample.derivatives.size() + Index(run.FilledUp() - run.count), 0);
  return value;
}

void PlanarField::Evaluate(const Vector2d& point, PlanarSample& sample) {
  sample.value = 0;
  sample.gradient.setZero();
  sample.derivatives.clear();
  values_.clear();
  gradients_.clear();
  sample.runs.clear();
  double largest = 0;
  for (const Polyline& line : lines_) {
    if ((point - line.center).squaredNorm() >= line.reach * line.reach) continue;
    largest = std::max(largest, AddPolyline(line, point, sample));
  }
  if (largest <= 0) return;
  double sum = 0;
  for (const double v : values_) sum += ShareOf(v / largest);
  sample.value = largest * std::sqrt(std::sqrt(sum));
  for (std::size_t c = 0, k = 0; c < values_.size(); ++c) {
    const double share = SlopeOf(values_[c] / sample.value);
    sample.gradient += share * gradients_[c];
    for (int i = 0; i < sample.runs[c].FilledUp(); ++i) sample.derivatives[k++] *= share;
  }
}

}  // namespace lascaux

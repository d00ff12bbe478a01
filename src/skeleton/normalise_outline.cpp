#include "lascaux/skeleton/normalise_outline.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "lascaux/base/arena.h"
#include "lascaux/field/compiled_field.h"
#include "skeleton/index.h"
#include "skeleton/smoothstep.h"
#include "skeleton/union_outline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Spacing of the samples and of the table, in shares of the drawn outline's diagonal: a few
/// samples for each bump that a pen makes.
constexpr double kSpacing = 2.5e-3, kCell = 2e-3;
/// The gain fades over this share of the local radius, but over so many cells at least and this
/// share of the diagonal at most.
constexpr double kFade = 0.6, kLeastFade = 4, kMostFade = 0.05;
/// Integral of the kernel (1 - q^2)^3 over a line through its middle, q from -1 to 1.
constexpr double kKernelIntegral = 32.0 / 35;
/// The maximum over z: so many steps from the plane to the deepest part and the middles of so many
/// parts, then as many places between the neighbours of the best, each time finer.
constexpr int kDepthSteps = 8, kMiddles = 4, kRefinements = 2;
/// Richardson steps towards sources whose sum is the wanted gain. High frequencies come last, and
/// stay out: they would be stripes.
constexpr int kSteps = 12;

/// What the outline has to give up over this many fades to either side is undone by wide kernels.
/// The rest, wobbles of the pen for the most part, is undone by narrow ones: carried round the body
/// by wide ones, each wobble would be a ring.
constexpr double kCalm = 2;
/// Steepest slope of the kernel (1 - q^2)^3, and of log F at the surface of a cylinder of radius 1.
constexpr double kKernelSlope = 1.72, kFieldSlope = 7.0 / 3;
/// Narrow kernels may be as steep as this share of the field's slope: steeper ones would be
/// grooves.
constexpr double kMostSlope = 0.25;

/// A place of the outline in model units, and the source of gain there.
struct Sample {
  Vector2d place;
  double radius = 0;  ///< of the disc there
  double fade = 0;    ///< distance at which its source ends
  double length = 0;  ///< of the outline that it stands for
  double wanted = 0;  ///< log gain
  double source = 0;
};

/// The discs at the ends of the segments and halfway between them.
std::vector<SkeletonVertex> DiscsOf(const Field& field) {
  std::vector<SkeletonVertex> discs;
  for (const FieldPart& part : field.parts) {
    for (const FieldChain& chain : part.chains) {
      for (const Segment& s : chain.segments) {
        const SkeletonVertex a{s.a.head<2>(), s.radius_a}, b{s.b.head<2>(), s.radius_b};
        if (discs.empty() || discs.back().position != a.position) discs.push_back(a);
        discs.push_back({(a.position + b.position) / 2, (a.radius + b.radius) / 2});
        discs.push_back(b);
      }
    }
  }
  return discs;
}

/// Radius of the disc whose circle passes nearest.
double LocalRadius(const std::vector<SkeletonVertex>& discs, const Vector2d& place) {
  double nearest = std::numeric_limits<double>::infinity(), radius = 0;
  for (const SkeletonVertex& disc : discs) {
    const double distance = std::abs((disc.position - place).norm() - disc.radius);
    if (distance < nearest) nearest = distance, radius = disc.radius;
  }
  return radius;
}

/// Lines along z that are looked at together: as many as fill a tile of the vector code.
constexpr std::size_t kLines = 4;
constexpr std::size_t kLinePoints = kDepthSteps + kMiddles + 1;
using LinePoints = std::array<double, kLinePoints>;

/// Where the greatest F on a line along z may be; the field is symmetric, so z >= 0 is enough.
class Depths {
 public:
  explicit Depths(const Field& field) : field_(field) {
    for (std::size_t i = 0; i < field.parts.size(); ++i) {
      Field alone;
      alone.parts.push_back(field.parts[i]);
      alone.parts[0].parent.reset();
      boxes_.push_back(Bounds(alone));
      if (boxes_.back().isEmpty()) continue;
      const Eigen::AlignedBox3d& box = boxes_.back();
      const auto& depth = field.parts[i].depth;
      const double z = depth
                           ? RangeOf(*depth, {box.min().head<2>(), box.max().head<2>()}).middle_high
                           : field.parts[i].z0;
      deepest_ = std::max(deepest_, z);
    }
  }

  /// Even steps, and the middles of the parts that are there, on which each by itself is greatest:
  /// thin ones would fall between the steps.
  LinePoints At(const Vector2d& place) const {
    LinePoints depths;
    depths.fill(0);
    for (int k = 0; k <= kDepthSteps; ++k) {
      depths[Index(k)] = deepest_ * k / kDepthSteps;
    }
    std::size_t next = kDepthSteps + 1;
    for (std::size_t i = field_.parts.size(); i-- > 0 && next < kLinePoints;) {
      const FieldPart& part = field_.parts[i];
      const Eigen::AlignedBox3d& box = boxes_[i];
      if (part.z0 < 0 || !(place.x() > box.min().x() && place.x() < box.max().x() &&
                           place.y() > box.min().y() && place.y() < box.max().y()))
        continue;
      depths[next++] =
          part.depth ? std::max(EvaluateDepth(*part.depth, place).middle, 0.0) : part.z0;
    }
    std::sort(depths.begin(), depths.end());
    return depths;
  }

  double deepest() const { return deepest_; }

 private:
  const Field& field_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  double deepest_ = 0;
};

/// Even points between the neighbours of the best.
LinePoints Finer(const LinePoints& depths, std::size_t best) {
  const double low = depths[best > 0 ? best - 1 : 0];
  const double high = depths[std::min(best + 1, kLinePoints - 1)];
  LinePoints finer;
  for (std::size_t k = 0; k < kLinePoints; ++k) {
    finer[k] = low + (high - low) * static_cast<double>(k) / (kLinePoints - 1);
  }
  return finer;
}

/// The greatest F on the lines along z through up to kLines places near each other.
std::array<double, kLines> GreatestAlongZ(const CompiledField& field,
                                          std::span<const Sample> samples, const Depths& depths) {
  const Vector2d middle = samples[samples.size() / 2].place;
  double spread = 0;
  for (const Sample& s : samples) spread = std::max(spread, (s.place - middle).norm());
  const double half = depths.deepest() / 2;
  const Eigen::Vector3d origin(middle.x(), middle.y(), half);
  const BallBounds found = field.BoundOnBall({origin, std::hypot(spread, half)}, field.All());

  std::array<float, kLines * kLinePoints> x, y, z, value;
  std::array<LinePoints, kLines> lines;
  std::array<double, kLines> best{};
  for (std::size_t line = 0; line < samples.size(); ++line) {
    lines[line] = depths.At(samples[line].place);
  }
  const std::size_t count = samples.size() * kLinePoints;
  for (int round = 0; round <= kRefinements; ++round) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t line = i / kLinePoints;
      const Vector2d offset = samples[line].place - middle;
      x[i] = static_cast<float>(offset.x());
      y[i] = static_cast<float>(offset.y());
      z[i] = static_cast<float>(lines[line][i % kLinePoints] - half);
    }
    const auto first = [count](std::array<float, kLines * kLinePoints>& all) {
      return std::span(all).first(count);
    };
    field.EvaluateValues({origin, first(x), first(y), first(z)}, found.active, first(value));
    for (std::size_t line = 0; line < samples.size(); ++line) {
      const auto begin = value.begin() + static_cast<std::ptrdiff_t>(line * kLinePoints);
      const auto top = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(kLinePoints));
      best[line] = std::max(best[line], static_cast<double>(*top));
      lines[line] = Finer(lines[line], static_cast<std::size_t>(top - begin));
    }
  }
  return best;
}

/// The drawn outline as samples, their fades smoothed along it, and a share from 0 to 1 by which
/// each end of an open run is let go: there another part takes over, and a fillet is no error to be
/// cut out of both.
struct Samples {
  std::vector<Sample> all;
  std::vector<double> trust;
  std::vector<std::size_t> starts;  ///< of the runs, and the end of the last
};

Samples SampleOutlines(const Field& field, const DrawnOutline& drawn, double diagonal) {
  Samples samples;
  const std::vector<SkeletonVertex> discs = DiscsOf(field);
  for (const auto& run :
       UnionOutline(drawn.parts, drawn.graph, kSpacing * diagonal / drawn.frame.scale)) {
    const std::size_t n = run.size();
    std::vector<double> radii(n), arcs(n, 0);
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
      radii[k] = LocalRadius(discs, drawn.frame.ToModel(run[k]));
    });
    for (std::size_t k = 1; k < n; ++k)
      arcs[k] = arcs[k - 1] + drawn.frame.scale * (run[k] - run[k - 1]).norm();
    const bool closed = (run.front() - run.back()).norm() < kSpacing * diagonal / drawn.frame.scale;
    samples.starts.push_back(samples.all.size());
    for (std::size_t k = 0; k < n; ++k) {
      constexpr std::size_t kWindow = 6;
      const std::size_t low = k < kWindow ? 0 : k - kWindow, high = std::min(n - 1, k + kWindow);
      double mean = 0;
      for (std::size_t i = low; i <= high; ++i)
        mean += radii[i] / static_cast<double>(high - low + 1);
      const double fade =
          std::clamp(kFade * mean, kLeastFade * kCell * diagonal, kMostFade * diagonal);
      const double length = (arcs[std::min(n - 1, k + 1)] - arcs[k > 0 ? k - 1 : 0]) / 2;
      samples.all.push_back({drawn.frame.ToModel(run[k]), mean, fade, length});
      samples.trust.push_back(closed ? 1.0
                                     : Smoothstep(std::min(arcs[k], arcs.back() - arcs[k]) / fade));
    }
  }
  samples.starts.push_back(samples.all.size());
  return samples;
}

/// Calls visit(sample, other, share) for the samples of one run that are within kCalm fades along
/// it; the shares fall from 1 to 0.
template <typename Visit>
void ForEachNeighbour(const Samples& samples, Visit visit) {
  for (std::size_t run = 0; run + 1 < samples.starts.size(); ++run) {
    const std::size_t first = samples.starts[run], end = samples.starts[run + 1];
    for (std::size_t i = first; i < end; ++i) {
      const double window = kCalm * samples.all[i].fade;
      visit(i, i, 1.0);
      for (const bool forward : {false, true}) {
        double way = 0;
        for (std::size_t j = i; forward ? j + 1 < end : j > first;) {
          const std::size_t next = forward ? j + 1 : j - 1;
          way += (samples.all[next].place - samples.all[j].place).norm();
          if (way >= window) break;
          j = next;
          const double rest = 1 - way * way / (window * window);
          visit(i, j, rest * rest);
        }
      }
    }
  }
}

/// The same samples that want their neighbours' mean.
std::vector<Sample> Calmed(const Samples& samples) {
  std::vector<Sample> calm = samples.all;
  std::vector<double> sums(calm.size(), 0), weights(calm.size(), 0);
  ForEachNeighbour(samples, [&](std::size_t i, std::size_t j, double share) {
    const double weight = share * samples.all[j].length;
    sums[i] += weight * samples.all[j].wanted;
    weights[i] += weight;
  });
  for (std::size_t i = 0; i < calm.size(); ++i) {
    if (weights[i] > 0) calm[i].wanted = sums[i] / weights[i];
  }
  return calm;
}

/// Fades as narrow as what is wanted nearby allows.
void Narrow(Samples& samples, double least) {
  std::vector<double> most(samples.all.size(), 0);
  ForEachNeighbour(samples, [&](std::size_t i, std::size_t j, double share) {
    most[i] = std::max(most[i], share * std::abs(samples.all[j].wanted));
  });
  for (std::size_t i = 0; i < most.size(); ++i) {
    Sample& s = samples.all[i];
    const double needed = kKernelSlope / (kMostSlope * kFieldSlope) * most[i] * s.radius;
    s.fade = std::clamp(needed, least, std::max(least, s.fade));
  }
}

/// What a unit source adds at a distance: along an even straight outline the sum is 1 on it.
struct Kernel {
  double height, by_distance;

  explicit Kernel(const Sample& source)
      : height(source.length / (kKernelIntegral * source.fade)),
        by_distance(1 / (source.fade * source.fade)) {}

  double At(double squared_distance) const {
    const double rest = std::max(1 - squared_distance * by_distance, 0.0);
    return height * rest * rest * rest;
  }
};

/// Sources whose sum is the wanted gain at each sample; what is still wanted then.
std::vector<double> Solve(std::vector<Sample>& samples) {
  struct Entry {
    std::size_t sample;
    double weight;
  };
  std::vector<std::size_t> by_x(samples.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::stable_sort(by_x.begin(), by_x.end(), [&](std::size_t a, std::size_t b) {
    return samples[a].place.x() < samples[b].place.x();
  });
  std::vector<std::vector<Entry>> rows(samples.size());
  std::vector<double> sums(samples.size(), 0);
  const std::vector<Kernel> kernels(samples.begin(), samples.end());
  double widest = 0;
  for (const Sample& s : samples) widest = std::max(widest, s.fade);
  for (std::size_t a = 0; a < by_x.size(); ++a) {
    const std::size_t i = by_x[a];
    for (std::size_t b = a; b < by_x.size(); ++b) {
      const std::size_t j = by_x[b];
      const Vector2d way = samples[j].place - samples[i].place;
      if (way.x() > widest) break;
      const double squared = way.squaredNorm();
      if (squared >= widest * widest) continue;
      const double there = kernels[j].At(squared), here = kernels[i].At(squared);
      if (there > 0) rows[i].push_back({j, there}), sums[i] += there;
      if (here > 0 && i != j) rows[j].push_back({i, here}), sums[j] += here;
    }
  }
  std::vector<double> rest(samples.size());
  for (int step = 0; step <= kSteps; ++step) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      rest[i] = samples[i].wanted;
      for (const Entry& entry : rows[i]) rest[i] -= entry.weight * samples[entry.sample].source;
    }
    if (step == kSteps) break;
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i].source += rest[i] / std::max(sums[i], 1.0);
  }
  return rest;
}

constexpr int kRowsATask = 16;

/// Adds a sample's source to some rows of the table.
void AddSource(const Sample& s, int first_row, int end_row, PlanarGain& gain) {
  const Vector2d center = (s.place - gain.origin) / gain.cell;
  const double fade = s.fade / gain.cell;
  const int low = std::max(first_row, static_cast<int>(center.y() - fade));
  const int high = std::min(end_row - 1, static_cast<int>(center.y() + fade));
  if (low > high) return;
  const int left = std::max(0, static_cast<int>(center.x() - fade));
  const int right = std::min(gain.columns - 1, static_cast<int>(center.x() + fade));
  const Kernel kernel(s);
  const double by_distance = kernel.by_distance * gain.cell * gain.cell;
  const auto height = static_cast<float>(s.source * kernel.height);
  const Eigen::ArrayXf along =
      (by_distance *
       (Eigen::ArrayXd::LinSpaced(right - left + 1, left, right) - center.x()).square())
          .cast<float>();
  for (int row = low; row <= high; ++row) {
    const auto rest = static_cast<float>(1 - by_distance * (center.y() - row) * (center.y() - row));
    Eigen::Map<Eigen::ArrayXf> coefficients(
        gain.coefficients.data() + Index(row) * Index(gain.columns) + left, along.size());
    coefficients += height * (rest - along).max(0.0F).cube();
  }
}

PlanarGain TableOf(const std::vector<Sample>& samples, double cell) {
  Eigen::AlignedBox2d box;
  for (const Sample& s : samples) {
    box.extend(Vector2d(s.place - Vector2d::Constant(s.fade)));
    box.extend(Vector2d(s.place + Vector2d::Constant(s.fade)));
  }
  PlanarGain gain;
  gain.origin = box.min();
  gain.cell = cell;
  gain.columns = static_cast<int>(std::ceil(box.sizes().x() / cell)) + 1;
  gain.rows = static_cast<int>(std::ceil(box.sizes().y() / cell)) + 1;
  gain.coefficients.assign(Index(gain.columns) * Index(gain.rows), 0.0f);
  tbb::parallel_for(0, (gain.rows + kRowsATask - 1) / kRowsATask, [&](int task) {
    const int first = kRowsATask * task;
    for (const Sample& s : samples)
      AddSource(s, first, std::min(gain.rows, first + kRowsATask), gain);
  });
  return gain;
}

std::optional<PlanarGain> GainOf(const Field& field, const DrawnOutline& drawn, double diagonal) {
  Samples samples = SampleOutlines(field, drawn, diagonal);
  if (samples.all.empty()) return field.gain;
  const CompiledField compiled(field);
  const Depths depths(field);
  const std::size_t groups = (samples.all.size() + kLines - 1) / kLines;
  tbb::parallel_for(std::size_t{0}, groups, [&](std::size_t g) {
    const std::size_t first = g * kLines, count = std::min(kLines, samples.all.size() - first);
    const std::span<Sample> group = std::span(samples.all).subspan(first, count);
    const std::array<double, kLines> greatest = GreatestAlongZ(compiled, group, depths);
    for (std::size_t i = 0; i < count; ++i) {
      if (greatest[i] <= 0) continue;
      const double log_gain = std::clamp(-std::log(greatest[i]), -kMostLogGain, kMostLogGain);
      group[i].wanted = samples.trust[first + i] * log_gain;
    }
  });
  std::vector<Sample> sources = Calmed(samples);
  const std::vector<double> rest = Solve(sources);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    samples.all[i].wanted += rest[i] - sources[i].wanted;
  }
  Narrow(samples, kLeastFade * kCell * diagonal);
  Solve(samples.all);
  sources.insert(sources.end(), samples.all.begin(), samples.all.end());
  return TableOf(sources, kCell * diagonal);
}

}  // namespace

Field NormaliseOutline(Field field, const DrawnOutline& drawn, const Execution& execution) {
  const double diagonal = drawn.frame.scale * BuiltBox(drawn.parts, drawn.graph).diagonal().norm();
  if (!(diagonal > 0)) return field;
  RunInArena(execution, [&] { field.gain = GainOf(field, drawn, diagonal); });
  return field;
}

}  // namespace lascaux

#include "lascaux/skeleton/normalise_outline.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "lascaux/field/compiled_field.h"
#include "skeleton/index.h"
#include "skeleton/union_outline.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Spacing of the samples and of the table, in shares of the drawn outline's diagonal: a few
/// samples for each bump that a pen makes.
constexpr double kSpacing = 2.5e-3, kCell = 2e-3;
/// The gain fades over the local radius, and over so many cells at least.
constexpr double kLeastFade = 3;
/// The maximum over z: so many steps from the plane to the deepest part, then twice as many around
/// the best, each time finer.
constexpr int kDepthSteps = 12, kRefinements = 2;
/// Rounds in which the table's own smoothing is taken back.
constexpr int kRounds = 5;

/// A place of the outline in model units.
struct Sample {
  Vector2d place;
  double fade = 0;     ///< distance at which the gain is 1 again
  double wanted = 0;   ///< log gain
  double applied = 0;  ///< what the table is made from
};

/// A piece of outline between two samples.
struct Piece {
  std::size_t from = 0, to = 0;
};

struct SampledRuns {
  std::vector<Sample> samples;
  std::vector<Piece> pieces;
};

/// Radius of the disc of the skeleton whose circle passes nearest.
double LocalRadius(const Field& field, const Vector2d& place) {
  double nearest = std::numeric_limits<double>::infinity(), radius = 0;
  const auto consider = [&](const Eigen::Vector3d& center, double r) {
    const double distance = std::abs((center.head<2>() - place).norm() - r);
    if (distance < nearest) nearest = distance, radius = r;
  };
  for (const FieldPart& part : field.parts) {
    for (const FieldChain& chain : part.chains) {
      for (const Segment& segment : chain.segments) {
        consider(segment.a, segment.radius_a);
        consider(segment.b, segment.radius_b);
        consider((segment.a + segment.b) / 2, (segment.radius_a + segment.radius_b) / 2);
      }
    }
  }
  return radius;
}

double Deepest(const Field& field) {
  double deepest = 0;
  for (const FieldPart& part : field.parts) {
    for (const FieldChain& chain : part.chains) {
      for (const Segment& s : chain.segments) deepest = std::max({deepest, s.a.z(), s.b.z()});
    }
  }
  return deepest;
}

/// Lines along z that are looked at together: as many as fill a tile of the vector code.
constexpr std::size_t kLines = 4;
constexpr std::size_t kLinePoints = kDepthSteps + 1;

/// The greatest F on the lines along z through up to kLines places near each other; the field is
/// symmetric, so z >= 0 is enough.
std::array<double, kLines> GreatestAlongZ(const CompiledField& field,
                                          std::span<const Sample> samples, double deepest) {
  const Vector2d middle = samples[samples.size() / 2].place;
  double spread = 0;
  for (const Sample& s : samples) spread = std::max(spread, (s.place - middle).norm());
  const Eigen::Vector3d origin(middle.x(), middle.y(), 0.5 * deepest);
  const BallBounds found =
      field.BoundOnBall({origin, std::hypot(spread, 0.5 * deepest)}, field.All());

  std::array<float, kLines * kLinePoints> x, y, z, value;
  std::array<double, kLines> low{}, high, best{};
  high.fill(deepest);
  const std::size_t count = samples.size() * kLinePoints;
  for (int round = 0; round <= kRefinements; ++round) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t line = i / kLinePoints, k = i % kLinePoints;
      const Vector2d offset = samples[line].place - middle;
      x[i] = static_cast<float>(offset.x());
      y[i] = static_cast<float>(offset.y());
      const double share = static_cast<double>(k) / kDepthSteps;
      z[i] = static_cast<float>(low[line] + share * (high[line] - low[line]) - origin.z());
    }
    const auto first = [count](std::array<float, kLines * kLinePoints>& all) {
      return std::span(all).first(count);
    };
    field.EvaluateValues({origin, first(x), first(y), first(z)}, found.active, first(value));
    for (std::size_t line = 0; line < samples.size(); ++line) {
      const auto begin = value.begin() + static_cast<std::ptrdiff_t>(line * kLinePoints);
      const auto top = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(kLinePoints));
      best[line] = std::max(best[line], static_cast<double>(*top));
      const double step = (high[line] - low[line]) / kDepthSteps;
      const double at = low[line] + static_cast<double>(top - begin) * step;
      low[line] = std::max(0.0, at - step);
      high[line] = std::min(deepest, at + step);
    }
  }
  return best;
}

SampledRuns SampleRuns(const Field& field, const DrawnOutline& drawn, double diagonal) {
  SampledRuns outline;
  const double least_fade = kLeastFade * kCell * diagonal;
  for (const auto& run :
       UnionOutline(drawn.parts, drawn.graph, kSpacing * diagonal / drawn.frame.scale)) {
    for (std::size_t k = 0; k < run.size(); ++k) {
      if (k > 0) outline.pieces.push_back({outline.samples.size() - 1, outline.samples.size()});
      const Vector2d place = drawn.frame.ToModel(run[k]);
      outline.samples.push_back({place, std::max(LocalRadius(field, place), least_fade), 0, 0});
    }
  }
  return outline;
}

/// A coefficient near the outline: between which samples, how far along, and how much of their gain
/// it has.
struct Influence {
  std::size_t coefficient = 0;
  Piece piece;
  float along = 0, weight = 0;
};

PlanarGain EmptyTable(const SampledRuns& outline, double cell) {
  Eigen::AlignedBox2d box;
  for (const Sample& s : outline.samples) {
    box.extend(Vector2d(s.place - Vector2d::Constant(s.fade)));
    box.extend(Vector2d(s.place + Vector2d::Constant(s.fade)));
  }
  PlanarGain gain;
  gain.origin = box.min();
  gain.cell = cell;
  gain.columns = static_cast<int>(std::ceil(box.sizes().x() / cell)) + 1;
  gain.rows = static_cast<int>(std::ceil(box.sizes().y() / cell)) + 1;
  gain.coefficients.assign(Index(gain.columns) * Index(gain.rows), 0.0f);
  return gain;
}

/// For each coefficient the nearest piece of outline, if it is within reach.
std::vector<Influence> Influences(const SampledRuns& outline, const PlanarGain& gain) {
  std::vector<float> nearest(gain.coefficients.size(), std::numeric_limits<float>::infinity());
  std::vector<Influence> found(gain.coefficients.size());
  for (const Piece& piece : outline.pieces) {
    const Sample &a = outline.samples[piece.from], &b = outline.samples[piece.to];
    const Vector2d step = b.place - a.place;
    const Vector2d reach = Vector2d::Constant(std::max(a.fade, b.fade));
    const Vector2d low = (a.place.cwiseMin(b.place) - reach - gain.origin) / gain.cell;
    const Vector2d high = (a.place.cwiseMax(b.place) + reach - gain.origin) / gain.cell;
    for (int row = std::max(0, static_cast<int>(low.y()));
         row <= std::min(gain.rows - 1, static_cast<int>(high.y()) + 1); ++row) {
      for (int column = std::max(0, static_cast<int>(low.x()));
           column <= std::min(gain.columns - 1, static_cast<int>(high.x()) + 1); ++column) {
        const Vector2d place = gain.origin + gain.cell * Vector2d(column, row);
        const double t = std::clamp(
            (place - a.place).dot(step) / std::max(step.squaredNorm(), 1e-300), 0.0, 1.0);
        const double distance = (a.place + t * step - place).norm(),
                     fade = a.fade + t * (b.fade - a.fade);
        const std::size_t i = Index(row) * Index(gain.columns) + Index(column);
        if (distance >= fade || static_cast<float>(distance) >= nearest[i]) continue;
        nearest[i] = static_cast<float>(distance);
        const double share = 1 - distance * distance / (fade * fade);
        found[i] = {i, piece, static_cast<float>(t), static_cast<float>(share * share)};
      }
    }
  }
  std::erase_if(found, [](const Influence& influence) { return influence.weight == 0; });
  return found;
}

void Fill(PlanarGain& gain, const std::vector<Influence>& influences,
          const std::vector<Sample>& samples) {
  for (const Influence& i : influences) {
    const double a = samples[i.piece.from].applied, b = samples[i.piece.to].applied;
    const double value = a + static_cast<double>(i.along) * (b - a);
    gain.coefficients[i.coefficient] = i.weight * static_cast<float>(value);
  }
}

}  // namespace

Field NormaliseOutline(Field field, const DrawnOutline& drawn, const Execution& execution) {
  const double diagonal = drawn.frame.scale * BuiltBox(drawn.parts, drawn.graph).diagonal().norm();
  if (!(diagonal > 0)) return field;
  SampledRuns outline = SampleRuns(field, drawn, diagonal);
  if (outline.pieces.empty()) return field;

  const CompiledField compiled(field);
  const double deepest = std::max(Deepest(field), kCell * diagonal);
  tbb::task_arena arena(execution.threads > 0 ? execution.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    const std::size_t groups = (outline.samples.size() + kLines - 1) / kLines;
    tbb::parallel_for(std::size_t{0}, groups, [&](std::size_t g) {
      const std::size_t first = g * kLines,
                        count = std::min(kLines, outline.samples.size() - first);
      const std::span<Sample> group = std::span(outline.samples).subspan(first, count);
      const std::array<double, kLines> greatest = GreatestAlongZ(compiled, group, deepest);
      for (std::size_t i = 0; i < count; ++i) {
        if (greatest[i] <= 0) continue;
        group[i].wanted = std::clamp(-std::log(greatest[i]), -kMostLogGain, kMostLogGain);
        group[i].applied = group[i].wanted;
      }
    });
  });

  PlanarGain gain = EmptyTable(outline, kCell * diagonal);
  const std::vector<Influence> influences = Influences(outline, gain);
  Fill(gain, influences, outline.samples);
  for (int round = 0; round < kRounds; ++round) {
    for (Sample& sample : outline.samples) {
      sample.applied += sample.wanted - EvaluateLogGain(gain, sample.place).value;
      sample.applied = std::clamp(sample.applied, -2 * kMostLogGain, 2 * kMostLogGain);
    }
    Fill(gain, influences, outline.samples);
  }
  field.gain = std::move(gain);
  return field;
}

}  // namespace lascaux

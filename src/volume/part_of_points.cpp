#include "lascaux/volume/part_of_points.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <optional>
#include <utility>

#include "lascaux/base/arena.h"
#include "lascaux/field/compiled_field.h"
#include "volume/point_runs.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;

/// How much each part's field counts.
std::vector<float> SayOfParts(const Field& field) {
  std::vector<float> say;
  for (const FieldPart& part : field.parts) {
    float own = 1;
    for (auto parent = part.parent; parent;
         parent = field.parts[static_cast<std::size_t>(*parent)].parent)
      own *= kSayOfChild;
    say.push_back(own);
  }
  return say;
}

/// Each part by itself, ready for blocks.
std::vector<CompiledField> CompileParts(const Field& field) {
  std::vector<CompiledField> compiled;
  for (const FieldPart& part : field.parts) {
    Field alone;
    alone.chain_exponent = field.chain_exponent;
    alone.parts = {part};
    alone.parts[0].parent.reset();
    compiled.emplace_back(alone);
  }
  return compiled;
}

/// A part that may be the largest in a block, with the primitives that matter there.
struct Candidate {
  std::size_t part;
  float say;
  BallBounds found;
};

std::vector<Candidate> FindCandidates(const std::vector<CompiledField>& parts,
                                      const std::vector<float>& say, const Ball& ball) {
  std::vector<Candidate> candidates;
  float least = 0;  // some part has at least this everywhere
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].bounds().exteriorDistance(ball.center) > ball.radius) continue;
    BallBounds found = parts[p].BoundOnBall(ball, parts[p].All());
    if (!(found.bounds.upper > 0)) continue;
    least = std::max(least, say[p] * found.bounds.lower);
    candidates.push_back({p, say[p], std::move(found)});
  }
  std::erase_if(candidates,
                [least](const Candidate& c) { return c.say * c.found.bounds.upper < least; });
  return candidates;
}

}  // namespace

std::vector<std::uint16_t> PartOfPoints(const Field& field, std::span<const Eigen::Vector3f> points,
                                        const Vector3d& offset, const Execution& execution) {
  assert(field.parts.size() < kNoPart);
  std::vector<std::uint16_t> result(points.size(), kNoPart);
  const std::vector<CompiledField> parts = CompileParts(field);
  const std::vector<float> say = SayOfParts(field);
  const auto decide = [&](std::size_t first, std::size_t count) {
    const RunBlock block(points.subspan(first, count), offset);
    const std::span found = std::span(result).subspan(first, count);
    const std::vector<Candidate> candidates = FindCandidates(parts, say, block.ball);
    if (candidates.size() == 1 && candidates[0].found.bounds.lower > 0) {
      std::fill(found.begin(), found.end(), static_cast<std::uint16_t>(candidates[0].part));
      return;
    }
    std::vector<float> best(count, 0.0F), values(count);
    for (const Candidate& candidate : candidates) {
      parts[candidate.part].EvaluateValues(block.Points(), candidate.found.active, values);
      for (std::size_t i = 0; i < count; ++i) {
        const float value = candidate.say * values[i];
        if (value <= best[i]) continue;
        best[i] = value;
        found[i] = static_cast<std::uint16_t>(candidate.part);
      }
    }
  };
  RunInArena(execution, [&] {
    const PointRuns runs(points);
    tbb::parallel_for(std::size_t{0}, runs.count(), [&](std::size_t run) {
      decide(runs.First(run), runs.First(run + 1) - runs.First(run));
    });
  });
  return result;
}

}  // namespace lascaux

#include "lascaux/skeleton/fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "lascaux/base/arena.h"
#include "skeleton/check_creature.h"
#include "skeleton/extend_outline.h"
#include "skeleton/fit_part.h"
#include "skeleton/index.h"
#include "skeleton/ring.h"

namespace lascaux {
namespace {

/// Joints are found to this share of the part's diagonal.
constexpr double kJointTolerance = 3e-3;

/// Whether a part that abuts `index` has an outline that passes through `point`: a joint, and no
/// silhouette.
bool IsJoint(const Parts& parts, const Creature& creature, std::size_t index,
             const Eigen::Vector2d& point) {
  const double tolerance =
      kJointTolerance * Diagonal(parts.parts[Index(creature.parts[index].part)].outline.points);
  return std::any_of(creature.parts.begin(), creature.parts.end(), [&](const CreaturePart& child) {
    const Part& part = parts.parts[Index(child.part)];
    return child.parent && Index(*child.parent) == index && !part.over &&
           part.kind != PartKind::kIsland &&
           NearestOnRing(part.outline.points, point).distance < tolerance;
  });
}

/// What the part is to look like: its outline, extended into its parent, where what it shares with
/// a part that abuts it counts as little as a completion. Whatever else it shares, with a far limb
/// behind it, say, is its own contour.
Outline OutlineOf(const Parts& parts, const Creature& creature, std::size_t index) {
  const CreaturePart& part = creature.parts[index];
  Outline outline = part.parent
                        ? OutlineToFill(parts, part.part, creature.parts[Index(*part.parent)].part)
                        : parts.parts[Index(part.part)].outline;
  const std::size_t n = outline.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (outline.kinds[i] != OutlineKind::kShared) continue;
    const Eigen::Vector2d middle = (outline.points[i] + outline.points[(i + 1) % n]) / 2;
    outline.kinds[i] =
        IsJoint(parts, creature, index, middle) ? OutlineKind::kCompletion : OutlineKind::kDrawn;
  }
  return outline;
}

}  // namespace

Outcome<Creature> FitToDrawing(const Parts& parts, const Creature& creature,
                               const FitOptions& options, const Execution& execution) {
  if (Diagnostics wrong = CheckCreature(parts, creature); HasError(wrong)) {
    return Outcome<Creature>::Failure(std::move(wrong));
  }
  Creature fitted = creature;
  RunInArena(execution, [&] {
    tbb::parallel_for(std::size_t{0}, creature.parts.size(), [&](std::size_t i) {
      if (execution.IsCancelled()) return;
      fitted.parts[i].chains =
          FitChains(creature.parts[i].chains, OutlineOf(parts, creature, i), options);
    });
  });
  return fitted;
}

std::vector<FitError> MeasureFit(const Parts& parts, const Creature& creature, double spacing) {
  std::vector<FitError> errors;
  for (std::size_t i = 0; i < creature.parts.size(); ++i) {
    errors.push_back(
        MeasureChains(creature.parts[i].chains, OutlineOf(parts, creature, i), spacing));
  }
  return errors;
}

}  // namespace lascaux

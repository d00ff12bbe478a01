#include "lascaux/skeleton/fit.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <utility>

#include "skeleton/extend_outline.h"
#include "skeleton/fit_part.h"
#include "skeleton/index.h"

namespace lascaux {
namespace {

Outline OutlineOf(const Parts& parts, const Creature& creature, std::size_t index) {
  const CreaturePart& part = creature.parts[index];
  if (!part.parent) return parts.parts[Index(part.part)].outline;
  return OutlineToFill(parts, part.part, creature.parts[Index(*part.parent)].part);
}

}  // namespace

Outcome<Creature> FitToDrawing(const Parts& parts, const Creature& creature,
                               const FitOptions& options, const Execution& execution) {
  Creature fitted = creature;
  tbb::task_arena arena(execution.threads > 0 ? execution.threads : tbb::task_arena::automatic);
  arena.execute([&] {
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

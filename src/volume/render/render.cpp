#include "lascaux/volume/render.h"

#include <cassert>
#include <new>
#include <optional>
#include <utility>

#include "volume/arena.h"
#include "volume/render/painter.h"
#include "volume/render/scene.h"

namespace lascaux {
namespace {

/// Nothing when the run was cancelled.
std::optional<Picture> Paint(const ShownModel& model, const RenderOptions& options,
                             const Execution& execution) {
  const Scene scene(model, options);
  Painter painter(scene, options);
  if (execution.IsCancelled()) return std::nullopt;
  painter.PaintMiddles();
  if (execution.IsCancelled()) return std::nullopt;
  painter.PaintEdges();
  return painter.TakePicture();
}

/// What a model lacks to be shown.
Diagnostics Lacking(const ShownModel& model, Material material) {
  if (model.surface->activeVoxelCount() == 0) {
    return {Error(FailureKind::kInput, "empty-grid",
                  "the level set has no active voxel: there is nothing to show; build "
                  "it with a higher --resolution")};
  }
  if (material == Material::kDrawing && !model.color) {
    return {Error(FailureKind::kInput, "no-colors",
                  "there is no grid 'Cd' with the drawing's colours; build the volume with "
                  "--color, or show it in clay")};
  }
  if (material == Material::kParts && !model.part) {
    return {Error(FailureKind::kInput, "no-parts",
                  "there is no grid 'part' that says where each part is; build the volume with "
                  "--color, or show it in clay")};
  }
  return {};
}

}  // namespace

Outcome<Picture> Render(const ShownModel& model, const RenderOptions& options,
                        const Execution& execution) {
  assert(options.width > 0 && options.height > 0);
  using Result = Outcome<Picture>;
  Diagnostics lacking = Lacking(model, options.material);
  if (!lacking.empty()) return Result::Failure(std::move(lacking));
  std::optional<Picture> picture;
  try {
    RunInArena(execution, [&] { picture = Paint(model, options, execution); });
  } catch (const std::bad_alloc&) {
    return Result::Failure(Error(FailureKind::kUsage, "out-of-memory",
                                 "the picture does not fit into memory; ask for a smaller one"));
  }
  if (!picture) {
    return Result::Failure(
        Error(FailureKind::kInterrupted, "cancelled", "interrupted while rendering"));
  }
  return *std::move(picture);
}

}  // namespace lascaux

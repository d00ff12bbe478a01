#include "lascaux/volume/render_grids.h"

#include <utility>

#include "volume/render/draw_picture.h"
#include "volume/render/grid_coloring.h"
#include "volume/render/grid_leaves.h"

namespace lascaux {
namespace {

/// What a model lacks to be shown in a material.
Diagnostics Lacking(const ShownModel& model, Material material) {
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
  Diagnostics lacking = Lacking(model, options.material);
  if (!lacking.empty()) return Outcome<Picture>::Failure(std::move(lacking));
  return DrawPicture(LeavesOf(*model.surface), GridColoring(model, options.material), options,
                     execution);
}

}  // namespace lascaux

#include "lascaux/volume/render.h"

#include <cassert>
#include <new>
#include <optional>
#include <utility>

#include "lascaux/base/arena.h"
#include "volume/render/draw_picture.h"
#include "volume/render/painter.h"
#include "volume/render/scene.h"

namespace lascaux {
namespace {

/// Nothing when the run was cancelled.
std::optional<Picture> Paint(const Scene& scene, const RenderOptions& options,
                             const Execution& execution) {
  Painter painter(scene, options);
  if (execution.IsCancelled()) return std::nullopt;
  painter.PaintMiddles();
  if (execution.IsCancelled()) return std::nullopt;
  painter.PaintEdges();
  return painter.TakePicture();
}

}  // namespace

Outcome<Picture> DrawPicture(const LeafTable& surface, const Coloring& coloring,
                             const RenderOptions& options, const Execution& execution) {
  assert(options.width > 0 && options.height > 0);
  using Result = Outcome<Picture>;
  if (surface.empty()) {
    return Result::Failure(Error(FailureKind::kInput, "empty-grid",
                                 "the level set has no active voxel: there is nothing to show; "
                                 "build it with a higher --resolution"));
  }
  std::optional<Picture> picture;
  try {
    RunInArena(execution, [&] {
      const Scene scene(surface, coloring, options);
      picture = Paint(scene, options, execution);
    });
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

Outcome<Picture> Render(const NarrowBand& surface, const RenderOptions& options,
                        const Execution& execution) {
  return DrawPicture(LeafTable(surface), ClayColoring(), options, execution);
}

}  // namespace lascaux

#include "grid_plugin.h"

#include <utility>

#include "lascaux/io/write_vdb.h"
#include "lascaux/volume/level_set.h"
#include "lascaux/volume/render_grids.h"
#include "lascaux/volume/volume_grids.h"

namespace lascaux {
namespace {

Diagnostics WriteVolume(const std::filesystem::path& path, const ModelVolume& volume,
                        const WriteVdbOptions& options, const Execution& execution) {
  Diagnostics log;
  const auto grids = VolumeGrids(volume, execution).MoveInto(log);
  if (!grids) return log;
  const Diagnostics written = WriteVdb(path, *grids, options, execution);
  log.insert(log.end(), written.begin(), written.end());
  return log;
}

Outcome<std::vector<Picture>> RenderModel(const ModelVolume& model,
                                          const std::vector<std::array<float, 3>>& palette,
                                          const std::vector<RenderOptions>& options,
                                          const Execution& execution) {
  const auto surface = ToLevelSet(model.surface, execution);
  const ColorGrids grids = ColorsBesideSurface(*surface, model, execution);
  const ShownModel shown{surface, grids.color, grids.part, palette};
  std::vector<Picture> pictures;
  Diagnostics log;
  for (const RenderOptions& one : options) {
    auto picture = Render(shown, one, execution).MoveInto(log);
    if (!picture) return Outcome<std::vector<Picture>>::Failure(std::move(log));
    pictures.push_back(std::move(*picture));
  }
  return {std::move(pictures), std::move(log)};
}

}  // namespace
}  // namespace lascaux

extern "C" {
__attribute__((visibility("default"))) extern const lascaux::GridPlugin lascaux_grid_plugin;
const lascaux::GridPlugin lascaux_grid_plugin = {lascaux::WriteVolume, lascaux::RenderModel,
                                                 lascaux::PreparePrint, lascaux::RunRender};
}

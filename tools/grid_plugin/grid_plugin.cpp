#include "grid_plugin.h"

#include <utility>

#include "lascaux/io/write_vdb.h"
#include "lascaux/volume/level_set.h"
#include "lascaux/volume/render.h"

namespace lascaux {
namespace {

Diagnostics WriteBand(const std::filesystem::path& path, const NarrowBand& band,
                      const WriteVdbOptions& options, const Execution& execution) {
  return WriteVdb(path, *ToLevelSet(band, execution), options, execution);
}

Outcome<std::vector<Picture>> RenderBand(const NarrowBand& band,
                                         const std::vector<RenderOptions>& options,
                                         const Execution& execution) {
  const auto grid = ToLevelSet(band, execution);
  std::vector<Picture> pictures;
  Diagnostics log;
  for (const RenderOptions& one : options) {
    auto picture = Render(*grid, one, execution).MoveInto(log);
    if (!picture) return Outcome<std::vector<Picture>>::Failure(std::move(log));
    pictures.push_back(std::move(*picture));
  }
  return {std::move(pictures), std::move(log)};
}

}  // namespace
}  // namespace lascaux

extern "C" {
__attribute__((visibility("default"))) extern const lascaux::GridPlugin lascaux_grid_plugin;
const lascaux::GridPlugin lascaux_grid_plugin = {lascaux::WriteBand, lascaux::RenderBand,
                                                 lascaux::RunRender};
}

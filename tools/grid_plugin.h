#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/io/write_vdb_options.h"
#include "lascaux/volume/model_volume.h"
#include "lascaux/volume/narrow_band.h"
#include "lascaux/volume/picture.h"
#include "lascaux/volume/prepare_print.h"
#include "lascaux/volume/render_options.h"
#include "render_command.h"

/// @file
/// What needs OpenVDB's library. That takes 30 ms to load, longer than to understand a drawing: so
/// it is in a plugin that is loaded meanwhile, and not at all where nobody wants more than the
/// surface, or pictures in colour.

namespace lascaux {

struct GridPlugin {
  Diagnostics (*write_vdb)(const std::filesystem::path& path, const ModelVolume& volume,
                           const WriteVdbOptions& options, const Execution& execution);
  /// A picture for each of the options, in colour or with all layers. Material::kParts shows the
  /// palette, linear.
  Outcome<std::vector<Picture>> (*render)(const ModelVolume& model,
                                          const std::vector<std::array<float, 3>>& palette,
                                          const std::vector<RenderOptions>& options,
                                          const Execution& execution);
  Outcome<PreparedPrint> (*prepare_print)(const NarrowBand& band, const Mesh& mesh,
                                          const PrintOptions& options, const Execution& execution);
  ExitCode (*run_render)(const RenderCommandOptions& options, const Execution& execution);
};

/// Starts to load the plugin on a thread of its own, and returns.
void PreloadGridPlugin();

/// The plugin, when it is loaded. Error: "plugin-missing".
const Outcome<const GridPlugin*>& LoadGridPlugin();

}  // namespace lascaux

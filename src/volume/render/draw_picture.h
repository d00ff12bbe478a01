#pragma once

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/picture.h"
#include "lascaux/volume/render_options.h"
#include "volume/render/coloring.h"
#include "volume/render/leaf_table.h"

namespace lascaux {

/// The picture of a surface, whatever it is made of. The material among the options is not looked
/// at. Errors: "empty-grid", "out-of-memory", "cancelled".
Outcome<Picture> DrawPicture(const LeafTable& surface, const Coloring& coloring,
                             const RenderOptions& options, const Execution& execution);

}  // namespace lascaux

#pragma once

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/narrow_band.h"
#include "lascaux/volume/picture.h"
#include "lascaux/volume/render_options.h"

/// @file
/// Pictures of a level set, ray-marched on the processor, without OpenVDB.

namespace lascaux {

/// The model in clay: a large key light from the upper left, light from the sky and the floor with
/// occlusion, a rim light, a soft shadow on the floor. Filling 80 % of the frame, seen through a
/// long lens from slightly above; outlines have 8 samples a pixel.
///
/// The band is y up; the floor is at its lowest point. The options' material is not looked at
/// (render_grids.h). The same bytes for any number of threads. Errors: "empty-grid",
/// "out-of-memory", "cancelled".
///
/// Cost: 512 x 512 pixels of a 256-voxel model take 0.07 to 0.12 s of one processor, nearly
/// independent of the voxels.
Outcome<Picture> Render(const NarrowBand& surface, const RenderOptions& options = {},
                        const Execution& execution = {});

}  // namespace lascaux

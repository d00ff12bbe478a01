#pragma once

#include <openvdb/openvdb.h>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/picture.h"
#include "lascaux/volume/render_options.h"

/// @file
/// Pictures of a level set, ray-marched on the processor.

namespace lascaux {

/// The model in clay: a large key light from the upper left, light from the sky and the floor with
/// occlusion, a rim light, a soft shadow on the floor. Filling 80 % of the frame, seen through a
/// long lens from slightly above; outlines have 8 samples a pixel.
///
/// `grid` is a level set by OpenVDB's rules, negative inside, y up, in any unit, with a uniform
/// scale; the floor is at its lowest point. The same bytes for any number of threads. Errors:
/// "empty-grid", "out-of-memory", "cancelled".
///
/// Cost: 512 x 512 pixels of a 256-voxel model take 0.07 to 0.12 s of one processor, nearly
/// independent of the voxels.
Outcome<Picture> Render(const openvdb::FloatGrid& grid, const RenderOptions& options = {},
                        const Execution& execution = {});

}  // namespace lascaux

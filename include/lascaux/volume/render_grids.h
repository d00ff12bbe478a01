#pragma once

#include <openvdb/openvdb.h>

#include <array>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/picture.h"
#include "lascaux/volume/render_options.h"

/// @file
/// Pictures of OpenVDB's level sets, in any material.

namespace lascaux {

/// A level set and what goes with it, y up; the other grids may have voxels of their own, of which
/// the active ones count.
struct ShownModel {
  openvdb::FloatGrid::ConstPtr surface;
  openvdb::Vec3SGrid::ConstPtr color = {};  ///< linear, for Material::kDrawing
  openvdb::FloatGrid::ConstPtr part = {};   ///< indices, for Material::kParts and Picture::part
  std::vector<std::array<float, 3>> palette = {};  ///< of parts, linear; clay beyond its end
};

/// The same as Render() of render.h, in the material that the options name.
///
/// The surface is a level set by OpenVDB's rules, negative inside, y up, in any unit, with a
/// uniform scale. Errors: those of the other, "no-colors" and "no-parts" (the material needs a grid
/// that is not there).
Outcome<Picture> Render(const ShownModel& model, const RenderOptions& options = {},
                        const Execution& execution = {});

}  // namespace lascaux

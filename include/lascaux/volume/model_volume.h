#pragma once

#include <vector>

#include "lascaux/field/field.h"
#include "lascaux/volume/drawing_colors.h"
#include "lascaux/volume/mesh_details.h"
#include "lascaux/volume/narrow_band.h"
#include "lascaux/volume/up_axis.h"

/// @file
/// What the grids of a volume are made from, in plain values: without OpenVDB.

namespace lascaux {

/// Grids that go with the surface.
struct Companions {
  bool parts = false;  ///< a level set for each part
  bool fog = false;    ///< "density"
  bool color = false;  ///< "Cd" and "part"

  bool operator==(const Companions&) const = default;
};

/// A model as volume_grids.h takes it. The field and the surface must outlive it.
struct ModelVolume {
  const NarrowBand& surface;
  const Field& field;
  std::vector<MeshPart> parts;  ///< one for each of the field's
  double lift = 0;              ///< how far the surface lies above the field (y)
  Companions companions;
  UpAxis up = UpAxis::kY;                 ///< of the grids
  const DrawingColors* colors = nullptr;  ///< instead of the parts' colours
};

}  // namespace lascaux

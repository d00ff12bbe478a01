#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model.h"
#include "svg_text.h"

/// @file
/// What all layers of the parse picture share: its unit, its colours, and where labels go.

namespace lascaux {

/// Sizes and colours of a parse picture.
struct PictureStyle {
  Eigen::AlignedBox2d box;  ///< of the drawing, never empty
  double unit = 1;        ///< a hundredth of the drawing's diagonal, from which all sizes are made
  SvgNumbers numbers{1};  ///< formats coordinates
  std::vector<std::string> colors;  ///< of each part; a pair has one
};

/// The style for a model; parts that have a partner get its colour.
PictureStyle StyleFor(const Model& model);

/// A place for a part's label, and how much room there is around it.
struct LabelPlace {
  Eigen::Vector2d at;
  double room = 0;  ///< radius of the circle around it that lies in the part, roughly
};

/// A point well inside a ring: the middle of a wide horizontal chord with room on all sides.
LabelPlace InnerPlace(const std::vector<Eigen::Vector2d>& ring);

/// Where the label of a part goes: the centre of its largest disc, or a point inside its outline.
LabelPlace LabelPlaceOf(const Model& model, int part);

}  // namespace lascaux

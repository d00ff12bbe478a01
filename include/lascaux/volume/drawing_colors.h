#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/skeleton/creature.h"
#include "lascaux/sketch/page_colors.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"

/// @file
/// A drawing's colours on the model that was made of it.

namespace lascaux {

/// What one part of a model has of the drawing: a raster over its side view.
struct ColorLayer {
  int left = 0, top = 0, width = 0, height = 0;  ///< in the page's pixels
  std::vector<Eigen::Array3f> colors;            ///< linear
  Srgb8 color{};                                 ///< the most typical one
};

/// The colours of a model: each part has those of the drawing's pixels in which it is what is seen
/// of the model from the side, on both of its sides; where something hides it, and under lines,
/// those of the nearest such pixel.
struct DrawingColors {
  ModelFrame frame;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< of the page, sketch units
  double pixel = 1;                                  ///< sketch units
  std::vector<ColorLayer> layers;
  std::vector<std::uint16_t> layer_of_part;  ///< a part and its mirror image share one

  /// Linear colour of a part at a place of the model's x and y, bilinear between pixels.
  Eigen::Array3f At(std::size_t part, float x, float y) const noexcept;
  /// The colour for formats that have one a part: the median of what is seen, component by
  /// component; so an evenly filled area keeps its own.
  const Srgb8& OfPart(std::size_t part) const noexcept { return layers[layer_of_part[part]].color; }
};

/// The drawing as it is seen from the side: a mesh, which part each of its triangles belongs to,
/// and which of them share their colours.
struct ColoredView {
  const Mesh& mesh;
  std::span<const std::uint16_t> triangle_parts;
  std::vector<std::uint16_t> layer_of_part;  ///< parts beyond its end have no colours
  ModelFrame frame;
};

/// Nothing when the drawing has no colours: when less than 5 % of what is seen is painted neither
/// white nor as dark as ink. About 30 ms.
std::optional<DrawingColors> ProjectColors(const PageColors& page, const ColoredView& view,
                                           const Execution& execution = {});

}  // namespace lascaux

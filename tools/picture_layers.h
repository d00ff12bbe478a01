#pragma once

#include <Eigen/Core>
#include <string>

#include "model.h"
#include "picture_style.h"

/// @file
/// The layers of the parse picture, each the text of one SVG group; empty when the model has
/// nothing for it.

namespace lascaux {

std::string PartsLayer(const Model& model, const PictureStyle& style);
std::string InkLayer(const Model& model, const PictureStyle& style);
std::string ClosuresLayer(const Model& model, const PictureStyle& style);
std::string CompletionsLayer(const Model& model, const PictureStyle& style);
std::string SkeletonLayer(const Model& model, const PictureStyle& style);
std::string JunctionsLayer(const Model& model, const PictureStyle& style);
std::string BodyLayer(const Model& model, const PictureStyle& style);
std::string LabelsLayer(const Model& model, const PictureStyle& style);
/// The number of each stroke at its middle, as --overrides takes it.
std::string StrokeNumbersLayer(const Model& model, const PictureStyle& style);
/// Where the model's outline is furthest from the drawn one; empty before it was measured.
std::string FidelityLayer(const Model& model, const PictureStyle& style);
std::string DiagnosticsLayer(const Model& model, const PictureStyle& style);

/// A table of parts and diagnostics beside the drawing, its left edge at `left`; `end` is its lower
/// right corner.
struct Legend {
  std::string text;
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
};
Legend LegendLayer(const Model& model, const PictureStyle& style, double left);

}  // namespace lascaux

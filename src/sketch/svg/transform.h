#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string_view>

#include "sketch/svg/cursor.h"
#include "sketch/svg/length.h"

/// @file
/// The `transform`, `viewBox` and `preserveAspectRatio` attributes.

namespace lascaux::svg {

/// The product of a transform list, or why and where it can't be read.
struct Transform {
  Eigen::Affine2d value = Eigen::Affine2d::Identity();
  Fault fault = Fault::kNone;
  std::size_t offset = 0;
};

/// Reads matrix, translate, scale, rotate (about a point, too), skewX and skewY; angles in degrees.
/// "px" and "deg", which style sheets demand, are accepted.
Transform ParseTransform(std::string_view text);

/// A rectangle of user units.
struct Box {
  double x = 0, y = 0, width = 0, height = 0;
};

/// Nothing when it is not four numbers of which the last two are positive.
std::optional<Box> ParseViewBox(std::string_view text);

/// The map from the user units of `view_box` to those in which `viewport` is given, by
/// `preserve_aspect_ratio` ("" for the default "xMidYMid meet"; what can't be read is taken for the
/// default).
Eigen::Affine2d FitViewBox(const Box& view_box, const Box& viewport,
                           std::string_view preserve_aspect_ratio);

}  // namespace lascaux::svg

#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "sketch/svg/length.h"
#include "sketch/svg/path_data.h"

/// @file
/// The basic shapes as subpaths, drawn from where and in the direction that SVG 1.1, section 9
/// states.

namespace lascaux::svg {

enum class ShapeKind : std::uint8_t {
  kPath,
  kLine,
  kPolyline,
  kPolygon,
  kRect,
  kCircle,
  kEllipse,
};

/// The kind of shape that an element of this local name is.
std::optional<ShapeKind> ShapeOf(std::string_view tag);

/// A shape's outline, or what is wrong with one of its attributes.
struct Shape {
  PathData path;
  std::string_view attribute;  ///< the one that `path.fault` is in
};

/// Reads the geometry of an element. A shape of no or of negative size draws nothing, which is no
/// fault.
Shape ReadShape(ShapeKind kind, const pugi::xml_node& element, const Viewport& viewport,
                int max_pieces);

}  // namespace lascaux::svg

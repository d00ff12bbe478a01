#include "sketch/svg/shapes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

constexpr std::array<std::pair<std::string_view, ShapeKind>, 7> kShapes{{
    {"path", ShapeKind::kPath},
    {"line", ShapeKind::kLine},
    {"polyline", ShapeKind::kPolyline},
    {"polygon", ShapeKind::kPolygon},
    {"rect", ShapeKind::kRect},
    {"circle", ShapeKind::kCircle},
    {"ellipse", ShapeKind::kEllipse},
}};

/// Lengths from attributes; the first that can't be read is remembered and stops the shape.
class Geometry {
 public:
  Geometry(const pugi::xml_node& element, const Viewport& viewport)
      : element_(element), viewport_(viewport) {}

  /// Nothing when the attribute is missing, "auto" or faulty.
  std::optional<double> Optional(const char* name, double percent_of) {
    const std::string_view text = element_.attribute(name).value();
    if (Trimmed(text).empty() || Trimmed(text) == "auto") return std::nullopt;
    const Length length = ParseLength(text, percent_of);
    if (!length.value && shape_.path.fault == Fault::kNone) {
      shape_.path.fault = length.fault;
      shape_.attribute = name;
    }
    return length.value;
  }

  double X(const char* name) { return Optional(name, viewport_.width).value_or(0); }
  double Y(const char* name) { return Optional(name, viewport_.height).value_or(0); }
  double Any(const char* name) { return Optional(name, viewport_.Diagonal()).value_or(0); }
  std::optional<double> OptionalX(const char* name) { return Optional(name, viewport_.width); }
  std::optional<double> OptionalY(const char* name) { return Optional(name, viewport_.height); }

  Shape Finish(PathBuilder builder) && {
    if (shape_.path.fault != Fault::kNone) return std::move(shape_);
    if (builder.overflowed()) shape_.path.fault = Fault::kTooLarge;
    shape_.path.subpaths = std::move(builder).Take();
    return std::move(shape_);
  }

 private:
  pugi::xml_node element_;
  Viewport viewport_;
  Shape shape_;
};

PathBuilder Ellipse(const Vector2d& centre, const Vector2d& radii, PathBuilder builder) {
  if (!(radii.x() > 0) || !(radii.y() > 0)) return builder;
  const Vector2d across(radii.x(), 0), down(0, radii.y());
  builder.MoveTo(centre + across);
  for (const Vector2d& to : {down, Vector2d(-across), Vector2d(-down), across}) {
    builder.ArcTo({radii, 0, false, true, centre + to});
  }
  builder.Close();
  return builder;
}

PathBuilder Rectangle(Geometry& geometry, PathBuilder builder) {
  const double x = geometry.X("x"), y = geometry.Y("y");
  const double width = geometry.X("width"), height = geometry.Y("height");
  const std::optional<double> given_rx = geometry.OptionalX("rx"),
                              given_ry = geometry.OptionalY("ry");
  if (!(width > 0) || !(height > 0)) return builder;
  const double rx = std::clamp(given_rx.value_or(given_ry.value_or(0)), 0.0, width / 2);
  const double ry = std::clamp(given_ry.value_or(given_rx.value_or(0)), 0.0, height / 2);
  const Vector2d radii = rx > 0 && ry > 0 ? Vector2d(rx, ry) : Vector2d::Zero();
  const double right = x + width, bottom = y + height;
  // Where the straight sides begin and end; the same number where corners use up a whole side.
  const double left_end = x + radii.x(), top_end = y + radii.y();
  const double right_end = radii.x() == width / 2 ? left_end : right - radii.x();
  const double bottom_end = radii.y() == height / 2 ? top_end : bottom - radii.y();
  const auto side = [&](const Vector2d& to) {
    if (builder.position() != to) builder.LineTo(to);
  };
  const auto corner = [&](const Vector2d& to) {
    if (builder.position() != to) builder.ArcTo({radii, 0, false, true, to});
  };
  builder.MoveTo({left_end, y});
  side({right_end, y});
  corner({right, top_end});
  side({right, bottom_end});
  corner({right_end, bottom});
  side({left_end, bottom});
  corner({x, bottom_end});
  side({x, top_end});
  corner({left_end, y});
  builder.Close();
  return builder;
}

}  // namespace

std::optional<ShapeKind> ShapeOf(std::string_view tag) {
  for (const auto& [name, kind] : kShapes) {
    if (tag == name) return kind;
  }
  return std::nullopt;
}

Shape ReadShape(ShapeKind kind, const pugi::xml_node& element, const Viewport& viewport,
                int max_pieces) {
  const char* const points = element.attribute("points").value();
  Geometry geometry(element, viewport);
  PathBuilder builder(max_pieces);
  switch (kind) {
    case ShapeKind::kPath:
      return {ParsePathData(element.attribute("d").value(), max_pieces), "d"};
    case ShapeKind::kPolyline:
      return {ParsePoints(points, Ends::kOpen, max_pieces), "points"};
    case ShapeKind::kPolygon:
      return {ParsePoints(points, Ends::kClosed, max_pieces), "points"};
    case ShapeKind::kLine:
      builder.MoveTo({geometry.X("x1"), geometry.Y("y1")});
      builder.LineTo({geometry.X("x2"), geometry.Y("y2")});
      break;
    case ShapeKind::kRect:
      builder = Rectangle(geometry, std::move(builder));
      break;
    case ShapeKind::kCircle: {
      const double radius = geometry.Any("r");
      builder = Ellipse({geometry.X("cx"), geometry.Y("cy")}, {radius, radius}, std::move(builder));
      break;
    }
    case ShapeKind::kEllipse: {
      const std::optional<double> rx = geometry.OptionalX("rx"), ry = geometry.OptionalY("ry");
      const Vector2d radii(rx.value_or(ry.value_or(0)), ry.value_or(rx.value_or(0)));
      builder = Ellipse({geometry.X("cx"), geometry.Y("cy")}, radii, std::move(builder));
      break;
    }
  }
  return std::move(geometry).Finish(std::move(builder));
}

}  // namespace lascaux::svg

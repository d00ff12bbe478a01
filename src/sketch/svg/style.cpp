#include "sketch/svg/style.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lascaux::svg {
namespace {

enum class Property : std::uint8_t {
  kColor,
  kDisplay,
  kFill,
  kFillOpacity,
  kFillRule,
  kOpacity,
  kStroke,
  kStrokeLinecap,
  kStrokeOpacity,
  kStrokeWidth,
  kTransform,
  kVisibility,
};

constexpr std::array<std::pair<std::string_view, Property>, 12> kProperties{{
    {"color", Property::kColor},
    {"display", Property::kDisplay},
    {"fill", Property::kFill},
    {"fill-opacity", Property::kFillOpacity},
    {"fill-rule", Property::kFillRule},
    {"opacity", Property::kOpacity},
    {"stroke", Property::kStroke},
    {"stroke-linecap", Property::kStrokeLinecap},
    {"stroke-opacity", Property::kStrokeOpacity},
    {"stroke-width", Property::kStrokeWidth},
    {"transform", Property::kTransform},
    {"visibility", Property::kVisibility},
}};

std::optional<Property> PropertyOf(std::string_view name) {
  for (const auto& [known, property] : kProperties) {
    if (EqualsIgnoringCase(name, known)) return property;
  }
  return std::nullopt;
}

std::optional<double> ParseOpacity(std::string_view text) {
  Cursor cursor(text);
  const std::optional<double> number = cursor.Number();
  if (!number) return std::nullopt;
  const double unit = cursor.Take('%') ? 100 : 1;
  if (!cursor.AtEnd()) return std::nullopt;
  return std::clamp(*number / unit, 0.0, 1.0);
}

std::optional<double> ParseWidth(std::string_view text, const Viewport& viewport) {
  const std::optional<double> width = ParseLength(text, viewport.Diagonal()).value;
  return width && *width >= 0 ? width : std::nullopt;
}

std::optional<LineCap> ParseCap(std::string_view text) {
  if (EqualsIgnoringCase(text, "butt")) return LineCap::kButt;
  if (EqualsIgnoringCase(text, "round")) return LineCap::kRound;
  if (EqualsIgnoringCase(text, "square")) return LineCap::kSquare;
  return std::nullopt;
}

std::optional<FillRule> ParseFillRule(std::string_view text) {
  if (EqualsIgnoringCase(text, "nonzero")) return FillRule::kNonZero;
  if (EqualsIgnoringCase(text, "evenodd")) return FillRule::kEvenOdd;
  return std::nullopt;
}

std::optional<bool> ParseVisibility(std::string_view text) {
  if (EqualsIgnoringCase(text, "visible")) return true;
  if (EqualsIgnoringCase(text, "hidden") || EqualsIgnoringCase(text, "collapse")) return false;
  return std::nullopt;
}

/// Applies declarations to a style, one after the other.
class Cascade {
 public:
  Cascade(const Style& parent, const Viewport& viewport)
      : parent_(parent), viewport_(viewport), style_(parent) {
    style_.opacity = 1;
    style_.displayed = true;
    style_.transform = {};
  }

  void Apply(std::string_view name, std::string_view value) {
    const std::optional<Property> property = PropertyOf(name);
    if (!property) return;
    value = Trimmed(value);
    const bool inherited = *property != Property::kDisplay && *property != Property::kOpacity &&
                           *property != Property::kTransform;
    if (EqualsIgnoringCase(value, "inherit")) {
      // The three that are not inherited by themselves have acted on the parent already.
      if (inherited) Copy(*property, parent_);
    } else if (EqualsIgnoringCase(value, "unset") || EqualsIgnoringCase(value, "revert")) {
      Copy(*property, inherited ? parent_ : Style());
    } else if (EqualsIgnoringCase(value, "initial")) {
      Copy(*property, Style());
    } else {
      Set(*property, value);
    }
  }

  /// Declarations that are important, or those that are not.
  enum class Layer : std::uint8_t { kNormal, kImportant };
  void Apply(const std::vector<Declaration>& declarations, Layer layer) {
    for (const Declaration& declaration : declarations) {
      if (declaration.important != (layer == Layer::kImportant)) continue;
      Apply(declaration.name, declaration.value);
    }
  }

  Style Finish() const {
    Style style = style_;
    style.opacity *= parent_.opacity;
    return style;
  }

 private:
  template <typename T>
  static void Assign(T& field, const std::optional<T>& value) {
    if (value) field = *value;
  }

  void Set(Property property, std::string_view value) {
    switch (property) {
      case Property::kColor: {
        const std::optional<Paint> paint = ParsePaint(value);
        if (paint && paint->kind == PaintKind::kColor) style_.color = paint->color;
        break;
      }
      case Property::kDisplay:
        style_.displayed = !EqualsIgnoringCase(value, "none");
        break;
      case Property::kFill:
        return Assign(style_.fill, ParsePaint(value));
      case Property::kFillOpacity:
        return Assign(style_.fill_opacity, ParseOpacity(value));
      case Property::kFillRule:
        return Assign(style_.fill_rule, ParseFillRule(value));
      case Property::kOpacity:
        return Assign(style_.opacity, ParseOpacity(value));
      case Property::kStroke:
        return Assign(style_.stroke, ParsePaint(value));
      case Property::kStrokeLinecap:
        return Assign(style_.cap, ParseCap(value));
      case Property::kStrokeOpacity:
        return Assign(style_.stroke_opacity, ParseOpacity(value));
      case Property::kStrokeWidth:
        return Assign(style_.stroke_width, ParseWidth(value, viewport_));
      case Property::kTransform:
        style_.transform = value;
        break;
      case Property::kVisibility:
        return Assign(style_.visible, ParseVisibility(value));
    }
  }

  void Copy(Property property, const Style& from) {
    switch (property) {
      case Property::kColor:
        style_.color = from.color;
        break;
      case Property::kDisplay:
        style_.displayed = from.displayed;
        break;
      case Property::kFill:
        style_.fill = from.fill;
        break;
      case Property::kFillOpacity:
        style_.fill_opacity = from.fill_opacity;
        break;
      case Property::kFillRule:
        style_.fill_rule = from.fill_rule;
        break;
      case Property::kOpacity:
        style_.opacity = from.opacity;
        break;
      case Property::kStroke:
        style_.stroke = from.stroke;
        break;
      case Property::kStrokeLinecap:
        style_.cap = from.cap;
        break;
      case Property::kStrokeOpacity:
        style_.stroke_opacity = from.stroke_opacity;
        break;
      case Property::kStrokeWidth:
        style_.stroke_width = from.stroke_width;
        break;
      case Property::kTransform:
        style_.transform = from.transform;
        break;
      case Property::kVisibility:
        style_.visible = from.visible;
        break;
    }
  }

  const Style& parent_;
  const Viewport& viewport_;
  Style style_;
};

}  // namespace

bool Style::DrawsLine() const {
  return visible && stroke.kind != PaintKind::kNone && stroke_width > 0 && stroke_opacity > 0 &&
         opacity > 0;
}

bool Style::Covers() const {
  constexpr double kOpaque = 0.95;
  return DrawsArea() && fill_opacity * opacity >= kOpaque;
}

bool Style::DrawsArea() const {
  return visible && fill.kind != PaintKind::kNone && fill_opacity > 0 && opacity > 0;
}

std::optional<Color> Style::ColorOf(const Paint& paint) const {
  if (paint.kind == PaintKind::kColor) return paint.color;
  if (paint.kind == PaintKind::kCurrentColor) return color;
  return std::nullopt;
}

ComputedStyle ComputeStyle(const Style& parent, const pugi::xml_node& element,
                           const StyleSheet& sheet, const Viewport& viewport) {
  Cascade cascade(parent, viewport);
  std::vector<Declaration> own;
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    const std::string_view name = attribute.name();
    if (name == "style") {
      own = ParseDeclarations(attribute.value());
    } else {
      cascade.Apply(name, attribute.value());
    }
  }
  const StyleSheet::Matches matches = sheet.Match(element);
  for (const Cascade::Layer layer : {Cascade::Layer::kNormal, Cascade::Layer::kImportant}) {
    for (const auto* block : matches.blocks) cascade.Apply(*block, layer);
    cascade.Apply(own, layer);
  }
  return {cascade.Finish(), matches.cost};
}

}  // namespace lascaux::svg

#include "sketch/svg/drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "sketch/svg/encoding.h"
#include "sketch/svg/reading.h"
#include "sketch/svg/shapes.h"
#include "sketch/svg/strokes.h"
#include "sketch/svg/style.h"
#include "sketch/svg/transform.h"

namespace lascaux::svg {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

enum class ElementKind : std::uint8_t {
  kGroup,
  kSvg,
  kSwitch,
  kUse,
  kShape,
  kForeign,   ///< drawn by other programs, but not with lines: noted
  kNotDrawn,  ///< definitions, metadata, other vocabularies
};

ElementKind KindOf(std::string_view tag) {
  if (tag == "g" || tag == "a") return ElementKind::kGroup;
  if (tag == "svg") return ElementKind::kSvg;
  if (tag == "switch") return ElementKind::kSwitch;
  if (tag == "use") return ElementKind::kUse;
  if (tag == "text" || tag == "image" || tag == "foreignObject") return ElementKind::kForeign;
  return ShapeOf(tag) ? ElementKind::kShape : ElementKind::kNotDrawn;
}

/// `href` of any vocabulary: SVG 1.1 has it in XLink's, SVG 2 in its own.
std::string_view Href(const pugi::xml_node& node) {
  std::string_view found;
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    if (name == "href") return attribute.value();
    if (LocalName(name) == "href") found = attribute.value();
  }
  return found;
}

/// Whether a child of a `switch` is for us: no extensions, and English or any language.
bool PassesConditions(const pugi::xml_node& node) {
  if (node.attribute("requiredExtensions")) return false;
  const pugi::xml_attribute language = node.attribute("systemLanguage");
  return !language || std::string_view(language.value()).find("en") != std::string_view::npos;
}

/// What an element inherits from those around it. A plain value: the walk's only stack is the call
/// stack.
struct Context {
  Style style;
  Affine2d to_sketch = Affine2d::Identity();
  Viewport viewport;
  bool is_clipped = false;  ///< something is cut off from what is drawn; we don't know what
  std::string_view use_id;  ///< of the nearest `use`, for shapes without an id of their own
  int depth = 0;
};

class Walker {
 public:
  Walker(const Document& document, const ReadSvgOptions& options)
      : document_(document), reading_(document, options) {
    for (const std::string& text : document.style_texts()) sheet_.Add(text);
  }

  Outcome<Sketch> Run() && {
    const pugi::xml_node root = document_.root();
    Context context;
    context.viewport = RootViewport(root);
    if (reading_.SpendOnVisit(root)) {
      const ComputedStyle computed = ComputeStyle({}, root, sheet_, context.viewport);
      context.style = computed.style;
      if (context.style.displayed) Children(root, context);
    }
    for (const auto& [tag, seen] : ignored_) {
      reading_.findings().Add("ignored-element", [&, &tag = tag, &seen = seen] {
        return Note("ignored-element",
                    fmt::format("{} {} {} left out (the first at {}); convert to paths what "
                                "belongs to the drawing",
                                seen.count, tag, seen.count == 1 ? "element was" : "elements were",
                                seen.place));
      });
    }
    if (reading_.failed()) {
      return Outcome<Sketch>::Failure(std::move(reading_.findings()).Take());
    }
    return std::move(strokes_).Finish(reading_);
  }

 private:
  /// With a viewBox the sketch has its units; without one the root's size is only what percentages
  /// refer to.
  Viewport RootViewport(const pugi::xml_node& root) {
    if (const std::optional<Box> box = reading_.ViewBoxOf(root)) return {box->width, box->height};
    const Viewport initial;
    return {reading_.LengthOf(root, "width", initial.width).value_or(initial.width),
            reading_.LengthOf(root, "height", initial.height).value_or(initial.height)};
  }

  void Children(const pugi::xml_node& parent, const Context& context) {
    for (const pugi::xml_node& child : parent.children()) {
      if (reading_.failed()) return;
      Element(child, context);
    }
  }

  void Element(const pugi::xml_node& node, const Context& around) {
    if (!reading_.SpendOnVisit(node)) return;
    const std::string_view tag = document_.Tag(node);
    const ElementKind kind = KindOf(tag);
    if (kind == ElementKind::kNotDrawn) return;
    const std::optional<Context> context = Enter(node, around);
    if (!context || !context->style.displayed) return;
    switch (kind) {
      case ElementKind::kGroup:
        return Children(node, *context);
      case ElementKind::kSvg:
        return InViewport(node, node, *context);
      case ElementKind::kSwitch:
        return Switch(node, *context);
      case ElementKind::kUse:
        return Use(node, *context);
      case ElementKind::kShape:
        return Draw(*ShapeOf(tag), node, *context);
      case ElementKind::kForeign: {
        Ignored& seen = ignored_[tag];
        if (seen.count++ == 0) seen.place = document_.Place(node);
        return;
      }
      case ElementKind::kNotDrawn:
        return;
    }
  }

  /// The context inside of an element: its style and transform. Nothing when the reading has
  /// failed.
  std::optional<Context> Enter(const pugi::xml_node& node, const Context& around) {
    const int max_depth = reading_.options().max_depth;
    if (around.depth >= max_depth) {
      reading_.Fail("too-large",
                    fmt::format("{} is nested more than {} deep, counting use; take groups apart",
                                reading_.Name(node), max_depth));
      return std::nullopt;
    }
    const ComputedStyle computed = ComputeStyle(around.style, node, sheet_, around.viewport);
    if (!reading_.SpendOnStyle(node, computed.cost)) return std::nullopt;
    Context context = around;
    ++context.depth;
    for (const char* name : {"clip-path", "mask", "filter"}) {
      context.is_clipped = context.is_clipped || node.attribute(name);
    }
    context.style = computed.style;
    if (computed.style.transform.empty()) return context;
    const Transform transform = ParseTransform(computed.style.transform);
    reading_.Report(node, "transform", transform.fault, transform.offset);
    if (reading_.failed()) return std::nullopt;
    context.to_sketch = around.to_sketch * transform.value;
    return context;
  }

  void Switch(const pugi::xml_node& node, const Context& context) {
    for (const pugi::xml_node& child : node.children()) {
      if (!reading_.SpendOnVisit(child)) return;
      // Other vocabularies and foreign objects are what a switch is there to avoid.
      const std::string_view tag = document_.Tag(child);
      if (tag.empty() || tag == "foreignObject" || !PassesConditions(child)) continue;
      return Element(child, context);
    }
  }

  /// The content of an `svg` or `symbol` in a viewport of its own; `sizer` is the element that
  /// gives its size: itself or a `use`.
  void InViewport(const pugi::xml_node& node, const pugi::xml_node& sizer, Context context) {
    const Viewport outer = context.viewport;
    const bool is_svg = document_.Tag(node) == "svg";
    const auto own = [&](const char* name, double whole) {
      return is_svg ? reading_.LengthOf(node, name, whole) : std::nullopt;
    };
    const auto size = [&](const char* name, double whole) {
      const auto asked = sizer == node ? std::nullopt : reading_.LengthOf(sizer, name, whole);
      return asked ? *asked : own(name, whole).value_or(whole);
    };
    const Box place{own("x", outer.width).value_or(0), own("y", outer.height).value_or(0),
                    size("width", outer.width), size("height", outer.height)};
    if (!(place.width > 0) || !(place.height > 0)) return;
    if (const std::optional<Box> box = reading_.ViewBoxOf(node)) {
      const std::string_view preserve = node.attribute("preserveAspectRatio").value();
      context.to_sketch = context.to_sketch * FitViewBox(*box, place, preserve);
      context.viewport = {box->width, box->height};
    } else {
      context.to_sketch.translate(Vector2d(place.x, place.y));
      context.viewport = {place.width, place.height};
    }
    Children(node, context);
  }

  void Use(const pugi::xml_node& node, Context context) {
    const std::string_view href = Trimmed(Href(node));
    const pugi::xml_node target =
        href.starts_with('#') ? document_.ById(href.substr(1)) : pugi::xml_node();
    if (!target || IsAround(target, node)) {
      return reading_.Warn("bad-reference", node,
                           fmt::format("refers to {}, which {}, and is ignored", Quoted(href),
                                       target ? "it is a part of" : "is not in this document"));
    }
    const double x = reading_.LengthOf(node, "x", context.viewport.width).value_or(0);
    const double y = reading_.LengthOf(node, "y", context.viewport.height).value_or(0);
    context.to_sketch.translate(Vector2d(x, y));
    const std::string_view id = node.attribute("id").value();
    if (!id.empty()) context.use_id = id;
    used_.push_back(target);
    const std::string_view tag = document_.Tag(target);
    if (tag != "symbol" && tag != "svg") {
      Element(target, context);
    } else if (reading_.SpendOnVisit(target)) {
      const std::optional<Context> inside = Enter(target, context);
      if (inside && inside->style.displayed) InViewport(target, node, *inside);
    }
    used_.pop_back();
  }

  /// Whether drawing `target` would come back to `node`: it is around it, in the tree or by `use`.
  bool IsAround(const pugi::xml_node& target, const pugi::xml_node& node) const {
    if (std::find(used_.begin(), used_.end(), target) != used_.end()) return true;
    pugi::xml_node ancestor = node;
    // What is nested deeper than this is never drawn.
    for (int i = 0; ancestor && i <= reading_.options().max_depth; ++i) {
      if (ancestor == target) return true;
      ancestor = ancestor.parent();
    }
    return false;
  }

  void Draw(ShapeKind kind, const pugi::xml_node& node, const Context& context) {
    const bool fills = context.style.DrawsArea() && kind != ShapeKind::kLine;
    if (!context.style.DrawsLine() && !fills) return;
    // A matrix without an inverse draws nothing, by the standard.
    if (context.to_sketch.linear().determinant() == 0) return;
    const Shape shape = ReadShape(kind, node, context.viewport, reading_.pieces_left());
    reading_.Report(node, shape.attribute, shape.path.fault, shape.path.offset);
    if (reading_.failed() || shape.path.subpaths.empty()) return;
    const std::string_view own_id = node.attribute("id").value();
    const std::string_view id = own_id.empty() ? context.use_id : own_id;
    const Pen pen{IsUtf8(id) ? std::string(id) : Latin1ToUtf8(id),
                  node,
                  context.style,
                  context.to_sketch,
                  shapes_drawn_++,
                  context.is_clipped};
    for (const Subpath& subpath : shape.path.subpaths) {
      // One without pieces takes memory as well.
      if (!reading_.SpendPieces(node, std::max<std::size_t>(1, subpath.pieces.size()))) return;
      strokes_.Add(subpath, pen);
    }
  }

  struct Ignored {
    int count = 0;
    std::string place;  ///< of the first
  };

  const Document& document_;
  Reading reading_;
  StyleSheet sheet_;
  StrokeCollector strokes_;
  int shapes_drawn_ = 0;
  std::vector<pugi::xml_node> used_;  ///< targets of the `use` elements that are being drawn
  std::map<std::string_view, Ignored> ignored_;
};

}  // namespace

Outcome<Sketch> ReadDrawing(const Document& document, const ReadSvgOptions& options) {
  return Walker(document, options).Run();
}

}  // namespace lascaux::svg

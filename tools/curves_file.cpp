#include "curves_file.h"

#include <fmt/format.h>

#include <cmath>

#include "json_values.h"
#include "lascaux/io/xml_text.h"
#include "svg_text.h"

namespace lascaux {
namespace {

/// As many decimals as the grid of traced curves has for a picture, or as a drawing of this size
/// needs.
SvgNumbers NumbersFor(const Model& model) {
  constexpr double kDecimalsOfSize = 1e5;  // SvgNumbers writes a hundred-thousandth of a diagonal
  const double diagonal = Bounds(*model.sketch).diagonal().norm();
  return SvgNumbers(model.trace ? kTraceGrid * kDecimalsOfSize : diagonal);
}

std::string ColorText(const std::optional<Color>& color) {
  if (!color) return "none";
  const auto level = [](double v) { return static_cast<int>(std::lround(255 * v)); };
  return fmt::format("#{:02x}{:02x}{:02x}", level((*color)[0]), level((*color)[1]),
                     level((*color)[2]));
}

std::string PathText(const Stroke& stroke, const SvgNumbers& n) {
  const std::string id =
      stroke.svg_id.empty() ? "" : fmt::format(" id=\"{}\"", EscapeXml(stroke.svg_id));
  const std::string data =
      stroke.is_dot ? fmt::format("M{}h0", n(stroke.pieces.front().p[0])) : n.Curve(stroke);
  const Color black{0, 0, 0};
  return fmt::format("<path{} fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\" d=\"{}\"/>\n", id,
                     ColorText(stroke.fill_color),
                     stroke.width > 0 ? ColorText(stroke.stroke_color.value_or(black)) : "none",
                     n(stroke.width), data);
}

}  // namespace

std::string CurvesText(const Model& model) {
  const SvgNumbers n = NumbersFor(model);
  Eigen::AlignedBox2d page = Bounds(*model.sketch);
  if (model.trace)
    page = {Eigen::Vector2d::Zero(), Eigen::Vector2d(model.trace->width, model.trace->height)};
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "viewBox=\"{} {} {} {}\">\n<g stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
      n(page.min().x()), n(page.min().y()), n(page.sizes().x()), n(page.sizes().y()));
  for (const Stroke& stroke : model.sketch->strokes) text += PathText(stroke, n);
  return text + "</g>\n</svg>\n";
}

std::string TraceFactsText(const Model& model) {
  Json json = {{"format", "lascaux.trace/1"},
               {"file", model.file},
               {"strokes", model.sketch->strokes.size()},
               {"trace", TraceJson(model.trace)},
               {"diagnostics", DiagnosticsJson(model.diagnostics)}};
  return JsonText(json);
}

}  // namespace lascaux

#include "parse_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "picture_layers.h"
#include "picture_style.h"

namespace lascaux {
namespace {

constexpr double kMargin = 5;        // units around everything
constexpr double kPixelsAUnit = 12;  // of the picture's own width and height

std::string Header(const PictureStyle& style, const Eigen::AlignedBox2d& page) {
  const SvgNumbers& n = style.numbers;
  const Eigen::Vector2d size = page.sizes();
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"{} {} {} {}\">\n",
      size.x() / style.unit * kPixelsAUnit, size.y() / style.unit * kPixelsAUnit, n(page.min().x()),
      n(page.min().y()), n(size.x()), n(size.y()));
  text += fmt::format(
      "<defs><pattern id=\"far\" width=\"{0}\" height=\"{0}\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect width=\"{1}\" height=\"{0}\" fill=\"#ffffff\" "
      "fill-opacity=\"0.55\"/></pattern></defs>\n",
      n(1.4 * style.unit), n(0.7 * style.unit));
  text += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fbfaf6\"/>\n",
                      n(page.min().x()), n(page.min().y()), n(size.x()), n(size.y()));
  return text;
}

}  // namespace

std::string ParsePictureText(const Model& model) {
  const PictureStyle style = StyleFor(model);
  const double margin = kMargin * style.unit;
  const double left = style.box.max().x() + 1.5 * margin;
  const Legend legend = LegendLayer(model, style, left);

  Eigen::AlignedBox2d page = style.box;
  page.extend(legend.end);
  page.min().array() -= margin;
  page.max().array() += margin;

  std::string text = Header(style, page);
  text += PartsLayer(model, style);
  text += InkLayer(model, style);
  text += CompletionsLayer(model, style);
  text += ClosuresLayer(model, style);
  text += SkeletonLayer(model, style);
  text += JunctionsLayer(model, style);
  text += BodyLayer(model, style);
  text += LabelsLayer(model, style);
  text += StrokeNumbersLayer(model, style);
  text += FidelityLayer(model, style);
  text += DiagnosticsLayer(model, style);
  return text + legend.text + "</svg>\n";
}

}  // namespace lascaux

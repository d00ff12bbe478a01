#include "picture_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lascaux/io/xml_text.h"

namespace lascaux {
namespace {

constexpr const char* kInk = "#22252b";
constexpr const char* kProblem = "#d7263d";
constexpr const char* kGuess = "#c77700";
constexpr const char* kRemark = "#6b7280";

std::string Group(const char* id, const std::string& attributes, const std::string& content) {
  if (content.empty()) return {};
  return fmt::format("<g id=\"{}\" {}>\n{}</g>\n", id, attributes, content);
}

std::string Circle(const PictureStyle& style, const Eigen::Vector2d& at, double radius) {
  const SvgNumbers& n = style.numbers;
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", n(at.x()), n(at.y()), n(radius));
}

/// Far parts first, the body under its limbs, islands on top.
int Rank(PartRole role) {
  switch (role) {
    case PartRole::kBackground:
      return 0;
    case PartRole::kBody:
      return 1;
    case PartRole::kSagittal:
      return 2;
    case PartRole::kForeground:
      return 3;
    case PartRole::kIsland:
      return 4;
    case PartRole::kIgnored:
      break;
  }
  return 5;
}

/// A ring around the place, and a numbered pin beside it; the code only where it matters, for a
/// drawing may have many notes.
std::string Pin(const Diagnostic& d, std::size_t number, const PictureStyle& style) {
  const SvgNumbers& n = style.numbers;
  const char* color = d.severity == Severity::kError     ? kProblem
                      : d.severity == Severity::kWarning ? kGuess
                                                         : kRemark;
  const Eigen::Vector2d pin = *d.at + style.unit * Eigen::Vector2d(1.8, -2.4);
  std::string text = fmt::format("<g fill=\"{0}\" stroke=\"{0}\"><title>{1}</title>\n", color,
                                 EscapeXml(d.message));
  text += fmt::format("<path d=\"{}\" stroke-width=\"{}\"/>\n", n.Line({*d.at, pin}),
                      n(0.25 * style.unit));
  text += fmt::format("<g fill=\"none\" stroke-width=\"{}\">{}</g>\n", n(0.3 * style.unit),
                      Circle(style, *d.at, 0.9 * style.unit));
  text += Circle(style, pin, 1.25 * style.unit);
  text += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"#ffffff\" stroke=\"none\" "
      "text-anchor=\"middle\" font-weight=\"bold\">{}</text>\n",
      n(pin.x()), n(pin.y() + 0.55 * style.unit), n(1.5 * style.unit), number);
  if (d.severity != Severity::kNote)
    text += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" stroke=\"none\">{}</text>\n",
                        n(pin.x() + 1.6 * style.unit), n(pin.y() + 0.5 * style.unit),
                        n(1.4 * style.unit), EscapeXml(d.code));
  return text + "</g>\n";
}

}  // namespace

std::string PartsLayer(const Model& model, const PictureStyle& style) {
  if (!model.graph) return {};
  const SvgNumbers& n = style.numbers;
  std::vector<std::size_t> order(model.graph->nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return Rank(model.graph->nodes[a].role) < Rank(model.graph->nodes[b].role);
  });
  std::string text;
  for (const std::size_t i : order) {
    const DepthNode& node = model.graph->nodes[i];
    const std::string ring = n.Ring(model.parts->parts[i].outline.points);
    const bool ignored = node.role == PartRole::kIgnored;
    text += fmt::format(
        "<path id=\"part-{}\" d=\"{}\" fill=\"{}\" fill-opacity=\"{}\"><title>{}</title></path>\n",
        i, ring, style.colors[i], ignored ? 0.35 : 0.75,
        EscapeXml(fmt::format("{} {} ({})", i, node.name, Name(node.role))));
    if (node.role == PartRole::kBackground)
      text += fmt::format("<path d=\"{}\" fill=\"url(#far)\"/>\n", ring);
  }
  return Group("parts", "stroke=\"none\"", text);
}

std::string InkLayer(const Model& model, const PictureStyle& style) {
  if (!model.sketch) return {};
  std::string text;
  for (std::size_t i = 0; i < model.sketch->strokes.size(); ++i)
    text += fmt::format("<path d=\"{}\"><title>stroke {}</title></path>\n",
                        style.numbers.Curve(model.sketch->strokes[i]), i);
  return Group(
      "ink",
      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" "
                  "stroke-linejoin=\"round\"",
                  kInk, style.numbers(0.35 * style.unit)),
      text);
}

std::string ClosuresLayer(const Model& model, const PictureStyle& style) {
  if (!model.map) return {};
  std::string text;
  for (const MapEdge& edge : model.map->edges)
    if (edge.stroke < 0) text += fmt::format("<path d=\"{}\"/>\n", style.numbers.Line(edge.points));
  return Group(
      "closures",
      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\"",
                  kProblem, style.numbers(0.6 * style.unit)),
      text);
}

std::string CompletionsLayer(const Model& model, const PictureStyle& style) {
  if (!model.parts) return {};
  std::string text;
  for (const Part& part : model.parts->parts) {
    if (!part.root) continue;
    for (const auto* line : {&part.root->closed_completion, &part.root->open_completion})
      if (!line->empty()) text += fmt::format("<path d=\"{}\"/>\n", style.numbers.Line(*line));
  }
  return Group(
      "completions",
      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{} {}\"",
                  kInk, style.numbers(0.3 * style.unit), style.numbers(1.1 * style.unit),
                  style.numbers(0.7 * style.unit)),
      text);
}

std::string SkeletonLayer(const Model& model, const PictureStyle& style) {
  if (!model.skeletons) return {};
  const SvgNumbers& n = style.numbers;
  std::string discs, bones, joints;
  for (const Skeleton& skeleton : *model.skeletons) {
    const auto at = [&skeleton](int i) {
      return skeleton.vertices[static_cast<std::size_t>(i)].position;
    };
    for (const SkeletonVertex& vertex : skeleton.vertices) {
      discs += Circle(style, vertex.position, vertex.radius);
      joints += Circle(style, vertex.position, 0.35 * style.unit);
    }
    for (const auto& [a, b] : skeleton.edges)
      bones += fmt::format("<path d=\"{}\"/>\n", n.Line({at(a), at(b)}));
  }
  return Group("discs",
               fmt::format(
                   "fill=\"none\" stroke=\"#3d5a80\" stroke-opacity=\"0.28\" stroke-width=\"{}\"",
                   n(0.16 * style.unit)),
               discs) +
         Group("skeleton",
               fmt::format("fill=\"none\" stroke=\"#1d3557\" stroke-width=\"{}\"",
                           n(0.28 * style.unit)),
               bones) +
         Group("joints", "fill=\"#1d3557\" stroke=\"none\"", joints);
}

std::string JunctionsLayer(const Model& model, const PictureStyle& style) {
  if (!model.map) return {};
  const SvgNumbers& n = style.numbers;
  std::string junctions, ends;
  for (const MapNode& node : model.map->nodes) {
    if (node.outgoing.size() >= 3) junctions += Circle(style, node.position, 0.6 * style.unit);
    if (node.outgoing.size() == 1) ends += Circle(style, node.position, 0.45 * style.unit);
  }
  return Group("junctions",
               fmt::format("fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"{}\"", kInk,
                           n(0.22 * style.unit)),
               junctions) +
         Group("free-ends", fmt::format("fill=\"{}\"", kInk), ends);
}

std::string BodyLayer(const Model& model, const PictureStyle& style) {
  if (!model.graph) return {};
  const SvgNumbers& n = style.numbers;
  const Eigen::Vector2d at = LabelPlaceOf(model, model.graph->body).at;
  const double r = 2.2 * style.unit;
  std::string text = Circle(style, at, r);
  for (const Eigen::Vector2d& d : {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0),
                                   Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)})
    text += fmt::format("<path d=\"{}\"/>\n", n.Line({at + 0.75 * r * d, at + 1.3 * r * d}));
  return Group(
      "body",
      fmt::format("fill=\"#ffffff\" fill-opacity=\"0.6\" stroke=\"{}\" stroke-width=\"{}\"", kInk,
                  n(0.3 * style.unit)),
      text);
}

std::string LabelsLayer(const Model& model, const PictureStyle& style) {
  if (!model.graph) return {};
  const SvgNumbers& n = style.numbers;
  std::string text;
  for (std::size_t i = 0; i < model.graph->nodes.size(); ++i) {
    const LabelPlace place = LabelPlaceOf(model, static_cast<int>(i));
    Eigen::Vector2d at = place.at;
    // Beside what is too small to be seen under its label.
    if (place.room < 2 * style.unit)
      at += Eigen::Vector2d(1, 1).normalized() * (place.room + 1.8 * style.unit);
    text += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", n(at.x()),
                        n(at.y() + 0.75 * style.unit), i);
  }
  return Group(
      "labels",
      fmt::format("font-family=\"sans-serif\" font-weight=\"bold\" font-size=\"{}\" "
                  "text-anchor=\"middle\" fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"{}\" "
                  "paint-order=\"stroke\" stroke-linejoin=\"round\"",
                  n(2.1 * style.unit), kInk, n(0.5 * style.unit)),
      text);
}

std::string StrokeNumbersLayer(const Model& model, const PictureStyle& style) {
  if (!model.sketch) return {};
  const SvgNumbers& n = style.numbers;
  std::string text;
  for (std::size_t i = 0; i < model.sketch->strokes.size(); ++i) {
    const Stroke& stroke = model.sketch->strokes[i];
    if (stroke.pieces.empty()) continue;
    const Eigen::Vector2d at = stroke.pieces[stroke.pieces.size() / 2].At(0.5);
    text += fmt::format("<text x=\"{}\" y=\"{}\">s{}</text>\n", n(at.x()),
                        n(at.y() + 0.4 * style.unit), i);
  }
  return Group("stroke-numbers",
               fmt::format("font-family=\"sans-serif\" font-size=\"{}\" text-anchor=\"middle\" "
                           "fill=\"#5a6472\" stroke=\"#ffffff\" stroke-width=\"{}\" "
                           "paint-order=\"stroke\" stroke-linejoin=\"round\"",
                           n(1.1 * style.unit), n(0.3 * style.unit)),
               text);
}

std::string FidelityLayer(const Model& model, const PictureStyle& style) {
  if (!model.fidelity || !model.frame) return {};
  const SvgNumbers& n = style.numbers;
  const Eigen::Vector2d at = model.frame->ToSketch(model.fidelity->worst_at);
  const Eigen::Vector2d label = at + style.unit * Eigen::Vector2d(1.4, 0.5);
  std::string text = Circle(style, at, 1.1 * style.unit);
  text += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\" stroke=\"none\">worst {:.2f} "
      "%</text>\n",
      n(label.x()), n(label.y()), n(1.3 * style.unit), kRemark, model.fidelity->worst_percent);
  return Group(
      "fidelity",
      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{}\"",
                  kRemark, n(0.2 * style.unit), n(0.5 * style.unit)),
      text);
}

std::string DiagnosticsLayer(const Model& model, const PictureStyle& style) {
  std::string text;
  for (std::size_t i = 0; i < model.diagnostics.size(); ++i)
    if (model.diagnostics[i].at) text += Pin(model.diagnostics[i], i + 1, style);
  return Group("diagnostics", "font-family=\"sans-serif\"", text);
}

}  // namespace lascaux

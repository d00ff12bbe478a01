#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "lascaux/io/xml_text.h"
#include "messages.h"
#include "picture_layers.h"

namespace lascaux {
namespace {

constexpr double kRow = 2.6;          // units from line to line
constexpr double kFont = 1.6;         // units
constexpr double kLegendColumn = 46;  // units
constexpr double kFewestRows = 16;    // in a column, however low the drawing is
constexpr std::size_t kFewestBelowHeading = 8;
constexpr std::size_t kLineLetters = 52;  // as many as fit a column

/// The text cut into lines at blanks.
std::vector<std::string> Wrap(const std::string& text) {
  std::vector<std::string> lines;
  std::string line, word;
  const auto flush = [&] {
    if (!line.empty() && line.size() + word.size() + 1 > kLineLetters) {
      lines.push_back(line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ')
      flush();
    else
      word += c;
  }
  flush();
  lines.push_back(line);
  return lines;
}

/// Rows from top to bottom; where they reach the drawing's lower end, on in the next column.
class Table {
 public:
  Table(const PictureStyle& style, double left)
      : style_(style),
        left_(left),
        y_(style.box.min().y()),
        end_(std::max(style.box.max().y(), y_ + kFewestRows * kRow * style.unit)) {}

  void Heading(const std::string& text) {
    KeepTogether(kFewestBelowHeading);
    Step(0.6);
    Row(text, 0, " font-weight=\"bold\"");
  }

  /// Begins a column where so many rows more would not fit.
  void KeepTogether(std::size_t rows) {
    if (y_ + static_cast<double>(rows) * kRow * style_.unit <= end_) return;
    if (y_ == style_.box.min().y()) return;
    lowest_ = std::max(lowest_, y_);
    left_ += kLegendColumn * style_.unit;
    y_ = style_.box.min().y();
  }

  void Row(const std::string& text, double indent, const std::string& attributes = "") {
    Step(1);
    const SvgNumbers& n = style_.numbers;
    text_ += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", n(left_ + indent * style_.unit),
                         n(y_ - 0.8 * style_.unit), attributes, EscapeXml(text));
  }

  /// A patch of colour at the left of the last row; far parts are hatched as in the drawing.
  void Swatch(const std::string& color, bool far) {
    const SvgNumbers& n = style_.numbers;
    for (const std::string& fill :
         far ? std::vector<std::string>{color, "url(#far)"} : std::vector<std::string>{color})
      text_ += fmt::format(
          "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\" fill=\"{}\"/>\n", n(left_),
          n(y_ - 2.1 * style_.unit), n(2.2 * style_.unit), n(1.6 * style_.unit),
          n(0.3 * style_.unit), fill);
  }

  Legend Finish() const {
    const std::string group = fmt::format(
        "<g id=\"legend\" font-family=\"sans-serif\" font-size=\"{}\" fill=\"#22252b\">\n",
        style_.numbers(kFont * style_.unit));
    return {group + text_ + "</g>\n", {left_ + kLegendColumn * style_.unit, std::max(lowest_, y_)}};
  }

 private:
  void Step(double rows) { y_ += rows * kRow * style_.unit; }

  const PictureStyle& style_;
  double left_, y_, end_;
  double lowest_ = -std::numeric_limits<double>::infinity();
  std::string text_;
};

std::string PartRow(const DepthGraph& graph, std::size_t i) {
  const DepthNode& node = graph.nodes[i];
  std::string text = fmt::format("{}  {}: {}", i, node.name, Name(node.role));
  if (node.parent) text += fmt::format(", {} {}", Name(node.relation), *node.parent);
  if (node.pair) text += fmt::format(", pair of {}", *node.pair);
  return text;
}

}  // namespace

Legend LegendLayer(const Model& model, const PictureStyle& style, double left) {
  Table table(style, left);
  if (model.graph) {
    table.Heading("Parts");
    for (std::size_t i = 0; i < model.graph->nodes.size(); ++i) {
      table.KeepTogether(1);
      table.Row(PartRow(*model.graph, i), 3.2);
      table.Swatch(style.colors[i], model.graph->nodes[i].role == PartRole::kBackground);
    }
  }
  if (!model.diagnostics.empty()) table.Heading("Findings");
  for (const auto& [number, d] : ListBriefly(model.diagnostics)) {
    const std::vector<std::string> lines = Wrap(d.message);
    table.KeepTogether(1 + lines.size());
    table.Row(fmt::format("{}  {}: {}", number, Name(d.severity), d.code), 0);
    for (const std::string& line : lines) table.Row(line, 2, " fill=\"#555b66\"");
  }
  return table.Finish();
}

}  // namespace lascaux

#include "summary.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <string>

namespace lascaux {
namespace {

std::string PartsSentence(const DepthGraph& graph) {
  const auto count = [&graph](PartRole role) {
    return std::count_if(graph.nodes.begin(), graph.nodes.end(),
                         [role](const DepthNode& node) { return node.role == role; });
  };
  const auto parts = static_cast<std::ptrdiff_t>(graph.nodes.size()) - count(PartRole::kIgnored);
  const auto pairs = count(PartRole::kForeground);
  return fmt::format("{} part{}, {} pair{} of limbs", parts, parts == 1 ? "" : "s", pairs,
                     pairs == 1 ? "" : "s");
}

std::string StrokesSentence(const Model& model) {
  std::string text = fmt::format("{} strokes", model.sketch->strokes.size());
  if (model.trace)
    text += fmt::format(" of a pen {:.1f} pixels wide, which cover {:.1f} % of the ink; {} regions",
                        model.trace->ink_width, 100 * model.trace->coverage,
                        model.trace->curve_regions);
  return text;
}

std::string MeshSentence(const Model& model) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : model.mesh->vertices) box.extend(vertex);
  const Eigen::Vector3f size = box.sizes();
  std::string text = fmt::format("{:.1f} x {:.1f} x {:.1f} mm, {} triangles", size.x(), size.y(),
                                 size.z(), model.mesh->triangles.size());
  if (model.fidelity)
    text += fmt::format(
        ", outline off by {:.2f} % of the diagonal in the mean, {:.2f} % at the 95th percentile",
        model.fidelity->contour_mean_percent, model.fidelity->contour_p95_percent);
  return text;
}

}  // namespace

Diagnostic Summary(const Model& model, const std::vector<OutputTarget>& targets) {
  std::string text = model.graph ? PartsSentence(*model.graph) : StrokesSentence(model);
  if (model.mesh) text += "; " + MeshSentence(model);
  const char* separator = "; wrote ";
  for (const OutputTarget& target : targets) {
    text += separator + (IsStandardOutput(target) ? "to standard output" : target.path.string());
    separator = ", ";
  }
  if (targets.empty()) text += "; nothing was asked to be written (-o FILE)";
  if (!model.graph) return Note("traced", text);
  return model.mesh ? Note("built", text) : Note("understood", text);
}

}  // namespace lascaux

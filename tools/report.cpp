#include "report.h"

#include <optional>

#include "json_values.h"
#include "record_print.h"

namespace lascaux {
namespace {

Json SketchJson(const Model& model) {
  Json json = {{"file", model.file},
               {"strokes", nullptr},
               {"bounds", nullptr},
               {"trace", TraceJson(model.trace)}};
  if (!model.sketch) return json;
  json["strokes"] = model.sketch->strokes.size();
  const Eigen::AlignedBox2d box = Bounds(*model.sketch);
  if (!box.isEmpty()) json["bounds"] = {PointJson(box.min()), PointJson(box.max())};
  return json;
}

Json MatrixJson(const Model& model) {
  if (!model.mesh) return nullptr;  // the shift in y is known only then
  const ModelFrame& frame = *model.frame;
  return {{frame.scale, 0.0, frame.shift.x()}, {0.0, -frame.scale, frame.shift.y()}};
}

/// Depth of a part's drawn side in millimetres; background parts stand opposite their partners.
Json DepthJson(const Model& model, int part) {
  if (!model.creature || !model.frame) return nullptr;
  const DepthNode& node = model.graph->nodes[static_cast<std::size_t>(part)];
  const bool far = node.role == PartRole::kBackground;
  const int built = far ? node.pair.value_or(-1) : part;
  for (const CreaturePart& p : model.creature->parts)
    if (p.part == built) return (far ? -p.z : p.z) * model.frame->scale + 0.0;  // no -0
  return nullptr;
}

/// The part whose entry in the report holds this one. A far limb that is seen in several pieces is
/// one part with several outlines: the piece that its near partner names holds the others.
int EntryOf(const DepthGraph& graph, int part) {
  const DepthNode& node = graph.nodes[static_cast<std::size_t>(part)];
  if (node.role != PartRole::kBackground || !node.pair) return part;
  return graph.nodes[static_cast<std::size_t>(*node.pair)].pair.value_or(part);
}

Json OutlinesJson(const Model& model, int entry) {
  Json json = Json::array();
  for (int i = 0; i < static_cast<int>(model.graph->nodes.size()); ++i)
    if (EntryOf(*model.graph, i) == entry)
      json.push_back(RingJson(model.parts->parts[static_cast<std::size_t>(i)].outline.points));
  return json;
}

/// Null where nothing of the part shows in the animal's outline.
Json PartFidelityJson(const Model& model, int part) {
  const auto index = static_cast<std::size_t>(part);
  if (!model.fidelity || index >= model.fidelity->rings.size()) return nullptr;
  const std::optional<RingFidelity>& found = model.fidelity->rings[index];
  if (!found) return nullptr;
  return {{"contour_mean_percent", found->mean_percent},
          {"contour_p95_percent", found->p95_percent},
          {"worst_percent", found->worst_percent}};
}

Json PartJson(const Model& model, int part) {
  const DepthNode& node = model.graph->nodes[static_cast<std::size_t>(part)];
  const std::optional<LimbRoot>& root = model.parts->parts[static_cast<std::size_t>(part)].root;
  const bool related = node.relation != Relation::kNone;
  return {{"id", part},
          {"name", node.name},
          {"role", Name(node.role)},
          {"parent", node.parent ? Json(EntryOf(*model.graph, *node.parent)) : Json()},
          {"relation", related ? Json(Name(node.relation)) : Json()},
          {"pair", OrNull(node.pair)},
          {"z", DepthJson(model, part)},
          {"outlines", OutlinesJson(model, part)},
          {"evidence", root ? Json(Name(root->evidence)) : Json()},
          {"energy", root ? Json(root->energy) : Json()},
          {"choice", ChoiceJson(node.choice)},
          {"fidelity", PartFidelityJson(model, part)}};
}

/// Parts that are ignored are no part of the model; the parse picture shows them.
Json PartsJson(const Model& model) {
  Json json = Json::array();
  if (!model.graph) return json;
  for (int i = 0; i < static_cast<int>(model.graph->nodes.size()); ++i)
    if (model.graph->nodes[static_cast<std::size_t>(i)].role != PartRole::kIgnored &&
        EntryOf(*model.graph, i) == i)
      json.push_back(PartJson(model, i));
  return json;
}

Json GridJson(const std::optional<GridFacts>& facts) {
  if (!facts) return nullptr;
  return {{"voxel_size", facts->voxel_size},
          {"active_voxels", facts->active_voxels},
          {"bytes", facts->bytes}};
}

Json MeshJson(const Model& model) {
  if (!model.facts) return nullptr;
  Json json = MeshFactsJson(*model.facts);
  json.update(PrintFactsJson(model.print));
  return json;
}

Json FidelityJson(const std::optional<Fidelity>& fidelity) {
  if (!fidelity) return nullptr;
  return {{"iou", fidelity->iou},
          {"contour_mean_percent", fidelity->contour_mean_percent},
          {"contour_p95_percent", fidelity->contour_p95_percent},
          {"worst_percent", fidelity->worst_percent}};
}

Json TimingsJson(const Timings& timings) {
  Json json = Json::object();
  for (const auto& [stage, milliseconds] : timings.stages) json[stage] = milliseconds;
  json["total"] = timings.total;
  return json;
}

}  // namespace

Json MeshFactsJson(const MeshFacts& facts) {
  return {
      {"vertices", facts.vertices},     {"triangles", facts.triangles},
      {"closed", facts.closed},         {"manifold", facts.manifold},
      {"oriented", facts.oriented},     {"self_intersections", OrNull(facts.self_intersections)},
      {"components", facts.components}, {"genus", OrNull(facts.genus)},
      {"volume", facts.volume},         {"area", facts.area},
      {"degenerate", facts.degenerate}, {"coincident", facts.coincident},
      {"invalid", facts.invalid}};
}

std::string ReportText(const Model& model, ReportTimings timings) {
  Json json = {{"format", "lascaux.report/1"},
               {"sketch", SketchJson(model)},
               {"model_from_sketch", MatrixJson(model)},
               {"body", nullptr}};
  if (model.graph)
    json["body"] = {{"id", model.graph->body}, {"score_margin", model.graph->body_margin}};
  json["parts"] = PartsJson(model);
  json["diagnostics"] = DiagnosticsJson(model.diagnostics);
  json["grid"] = GridJson(model.grid_facts);
  json["mesh"] = MeshJson(model);
  json["print"] = PrintRecordJson(model.print_record);
  json["fidelity"] = FidelityJson(model.fidelity);
  if (timings == ReportTimings::kWith) json["timings_ms"] = TimingsJson(model.timings);
  if (model.fidelity && model.frame) {
    json["fidelity"]["worst_at"] = PointJson(model.frame->ToSketch(model.fidelity->worst_at));
  }
  return JsonText(json);
}

}  // namespace lascaux

#include "parse_dump.h"

#include "json_values.h"

namespace lascaux {
namespace {

/// The list of the items' JSON forms, each made by `to_json`.
template <typename Items, typename ToJson>
Json ListJson(const Items& items, ToJson to_json) {
  Json json = Json::array();
  for (const auto& item : items) json.push_back(to_json(item));
  return json;
}

const char* Name(CycleKind kind) {
  switch (kind) {
    case CycleKind::kOuter:
      return "outer";
    case CycleKind::kBorder:
      return "border";
    case CycleKind::kIsland:
      return "island";
    case CycleKind::kHole:
      return "hole";
    case CycleKind::kOther:
      break;
  }
  return "other";
}

const char* Name(PartKind kind) {
  switch (kind) {
    case PartKind::kBorder:
      return "border";
    case PartKind::kLimb:
      return "limb";
    case PartKind::kIsland:
      return "island";
    case PartKind::kInner:
      break;
  }
  return "inner";
}

const char* Name(OutlineKind kind) {
  switch (kind) {
    case OutlineKind::kDrawn:
      return "drawn";
    case OutlineKind::kCompletion:
      return "completion";
    case OutlineKind::kShared:
      break;
  }
  return "shared";
}

Json StrokeJson(const Stroke& stroke) {
  return {{"svg_id", stroke.svg_id},
          {"closed", stroke.closed},
          {"dot", stroke.is_dot},
          {"width", stroke.width},
          {"stroke_color", OrNull(stroke.stroke_color)},
          {"fill_color", OrNull(stroke.fill_color)},
          {"pieces", ListJson(stroke.pieces, [](const CubicBezier& piece) {
             return ListJson(piece.p, PointJson);
           })}};
}

Json MapJson(const PlanarMap& map) {
  return {
      {"diagonal", map.diagonal},
      {"nodes", ListJson(map.nodes,
                         [](const MapNode& node) -> Json {
                           return {{"at", PointJson(node.position)}, {"outgoing", node.outgoing}};
                         })},
      {"edges", ListJson(map.edges,
                         [](const MapEdge& edge) -> Json {
                           return {{"stroke", edge.stroke < 0 ? Json() : Json(edge.stroke)},
                                   {"nodes", edge.nodes},
                                   {"points", RingJson(edge.points)}};
                         })},
      {"cycles", ListJson(map.cycles, [](const MapCycle& cycle) -> Json {
         return {{"kind", Name(cycle.kind)},
                 {"area", cycle.area},
                 {"inside", OrNull(cycle.inside)},
                 {"half_edges", cycle.half_edges}};
       })}};
}

Json RootJson(const LimbRoot& root) {
  return {{"evidence", Name(root.evidence)},
          {"energy", root.energy},
          {"closed", ListJson(root.closed, PointJson)},
          {"open", ListJson(root.open, PointJson)},
          {"closed_completion", RingJson(root.closed_completion)},
          {"open_completion", RingJson(root.open_completion)}};
}

Json PartJson(const Part& part) {
  return {
      {"kind", Name(part.kind)},
      {"over", OrNull(part.over)},
      {"strokes", part.strokes},
      {"cycles", part.cycles},
      {"stretches", part.stretches},
      {"root", part.root ? RootJson(*part.root) : Json()},
      {"outline", RingJson(part.outline.points)},
      {"outline_kinds", ListJson(part.outline.kinds, [](OutlineKind kind) { return Name(kind); })}};
}

Json GraphJson(const DepthGraph& graph) {
  return {{"body", graph.body},
          {"body_margin", graph.body_margin},
          {"order", graph.order},
          {"nodes", ListJson(graph.nodes, [](const DepthNode& node) -> Json {
             return {{"name", node.name},
                     {"role", Name(node.role)},
                     {"parent", OrNull(node.parent)},
                     {"relation", Name(node.relation)},
                     {"pair", OrNull(node.pair)},
                     {"choice", ChoiceJson(node.choice)}};
           })}};
}

Json DiscJson(const SkeletonVertex& vertex) {
  return {vertex.position.x(), vertex.position.y(), vertex.radius};
}

Json SkeletonJson(const Skeleton& skeleton) {
  return {{"part", skeleton.part},
          {"discs", ListJson(skeleton.vertices, DiscJson)},
          {"edges", skeleton.edges}};
}

Json CreaturePartJson(const CreaturePart& part) {
  return {{"part", part.part},
          {"parent", OrNull(part.parent)},
          {"z", part.z},
          {"mirrored", part.mirrored},
          {"depth_scale", part.depth_scale},
          {"stations", ListJson(part.stations,
                                [](const DepthStation& s) {
                                  return Json{s.position.x(), s.position.y(), s.z, s.scale};
                                })},
          {"chains", ListJson(part.chains, [](const Chain& chain) {
             return ListJson(chain.vertices, DiscJson);
           })}};
}

}  // namespace

std::string ParseDumpText(const Model& model) {
  Json json = {{"format", "lascaux.parse/1"}, {"file", model.file}};
  json["strokes"] = model.sketch ? ListJson(model.sketch->strokes, StrokeJson) : Json();
  json["map"] = model.map ? MapJson(*model.map) : Json();
  json["parts"] = model.parts ? ListJson(model.parts->parts, PartJson) : Json();
  json["graph"] = model.graph ? GraphJson(*model.graph) : Json();
  json["skeletons"] = model.skeletons ? ListJson(*model.skeletons, SkeletonJson) : Json();
  json["creature"] = model.creature ? ListJson(model.creature->parts, CreaturePartJson) : Json();
  json["diagnostics"] = DiagnosticsJson(model.diagnostics);
  return JsonText(json);
}

}  // namespace lascaux

#include "sample_model.h"

#include <utility>

namespace lascaux::testing {
namespace {

Part Box(PartKind kind, double x, double y, double width, double height) {
  Part part;
  part.kind = kind;
  part.outline.points = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  part.outline.kinds.assign(4, OutlineKind::kDrawn);
  return part;
}

DepthNode Node(PartRole role, std::string name, std::optional<int> parent, Relation relation) {
  DepthNode node;
  node.role = role;
  node.name = std::move(name);
  node.parent = parent;
  node.relation = relation;
  return node;
}

}  // namespace

Model SampleModel() {
  Model model;
  model.file = "sample.svg";
  Stroke stroke;
  stroke.pieces = {Line({0, 0}, {4, 0}), Line({4, 0}, {4, 2})};
  model.sketch = Sketch{{stroke}};

  Parts parts;
  parts.parts = {
      Box(PartKind::kBorder, 0, 0, 4, 2),         Box(PartKind::kLimb, 1, 1, 0.5, 2),
      Box(PartKind::kBorder, 1.6, 2, 0.4, 1),     Box(PartKind::kBorder, 0.8, 2, 0.2, 1),
      Box(PartKind::kIsland, 3.4, 0.4, 0.2, 0.2), Box(PartKind::kInner, 2, 0.5, 0.1, 0.1)};
  LimbRoot root;
  root.closed = {Eigen::Vector2d(1, 2), Eigen::Vector2d(1.5, 2)};
  root.open = {Eigen::Vector2d(1, 1.2), Eigen::Vector2d(1.5, 1.2)};
  root.closed_completion = {root.closed[0], root.closed[1]};
  root.open_completion = {root.open[0], root.open[1]};
  parts.parts[1].root = root;
  parts.parts[1].over = 0;
  model.parts = parts;

  DepthGraph graph;
  graph.nodes = {Node(PartRole::kBody, "body", {}, Relation::kNone),
                 Node(PartRole::kForeground, "limb-1", 0, Relation::kOver),
                 Node(PartRole::kBackground, "limb-1-far", 0, Relation::kUnder),
                 Node(PartRole::kBackground, "limb-1-far-2", 0, Relation::kUnder),
                 Node(PartRole::kIsland, "eye-4", 0, Relation::kOverIn),
                 Node(PartRole::kIgnored, "part-5", {}, Relation::kNone)};
  graph.nodes[1].pair = 2;
  graph.nodes[2].pair = graph.nodes[3].pair = 1;
  graph.order = {0, 1, 2, 3, 4, 5};
  graph.body_margin = 0.4;
  model.graph = graph;

  model.skeletons = std::vector<Skeleton>{{0, {{{1, 1}, 0.9}, {{3, 1}, 1}}, {{0, 1}}},
                                          {1, {{{1.25, 1.4}, 0.25}, {{1.25, 2.6}, 0.25}}, {{0, 1}}},
                                          {4, {{{3.5, 0.5}, 0.1}}, {}}};
  Creature creature;
  creature.parts = {{0, {}, {}, 0, false, 1}, {1, {}, 0, 0.9, true, 1}, {4, {}, 0, 0.8, true, 1}};
  model.creature = creature;
  model.frame = ModelFrame{10, {-20, 30}};
  model.timings.stages = {{"read", 1.5}, {"structure", 2.5}};
  model.timings.total = 4;
  return model;
}

}  // namespace lascaux::testing

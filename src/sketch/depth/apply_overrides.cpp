#include "sketch/depth/apply_overrides.h"

#include <string>

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Index = std::size_t;

std::optional<int> Find(const Parts& parts, const PartReference& reference) {
  const int count = static_cast<int>(parts.parts.size());
  if (const int* id = std::get_if<int>(&reference))
    return *id >= 0 && *id < count ? std::optional(*id) : std::nullopt;
  std::optional<int> best;
  const auto area = [&](int i) {
    return SignedArea(parts.parts[static_cast<Index>(i)].outline.points);
  };
  for (int i = 0; i < count; ++i) {
    const auto& ring = parts.parts[static_cast<Index>(i)].outline.points;
    if (!Contains(ring, std::get<Vector2d>(reference))) continue;
    if (!best || area(i) < area(*best)) best = i;
  }
  return best;
}

std::string Text(const PartReference& reference) {
  if (const int* id = std::get_if<int>(&reference)) return "part " + std::to_string(*id);
  char text[80];
  const Vector2d& at = std::get<Vector2d>(reference);
  std::snprintf(text, sizeof text, "a part around (%.6g, %.6g)", at.x(), at.y());
  return text;
}

Diagnostic Refusal(const PartReference& reference, const std::string& what) {
  Diagnostic error = Error(FailureKind::kUnderstanding, "override-not-there",
                           "the overrides name " + Text(reference) + ", " + what);
  if (const Vector2d* at = std::get_if<Vector2d>(&reference)) error = At(std::move(error), *at);
  return error;
}

/// Takes a part out of its pair; a far side that loses its near one is nothing by itself.
void Unpair(DepthGraph& graph, int part) {
  for (DepthNode& node : graph.nodes) {
    if (node.pair != part) continue;
    node.pair.reset();
    node.piece_of.reset();
    if (node.role != PartRole::kBackground) continue;
    node.role = PartRole::kIgnored;
    node.choice.reset();
  }
  DepthNode& node = graph.nodes[static_cast<Index>(part)];
  node.pair.reset();
  node.piece_of.reset();
  node.choice.reset();
}

/// What hangs on a part as more of it takes its role.
void PassOn(DepthGraph& graph, int part) {
  const PartRole role = graph.nodes[static_cast<Index>(part)].role;
  for (Index i = 0; i < graph.nodes.size(); ++i) {
    DepthNode& child = graph.nodes[i];
    const bool more = child.parent == part && child.relation == Relation::kAdjacent;
    if (!more || (role != PartRole::kForeground && role != PartRole::kSagittal)) continue;
    child.role = role;
    child.choice.reset();
    PassOn(graph, static_cast<int>(i));
  }
}

void SetFar(DepthGraph& graph, int part, int near) {
  DepthNode& node = graph.nodes[static_cast<Index>(part)];
  DepthNode& partner = graph.nodes[static_cast<Index>(near)];
  node.role = PartRole::kBackground;
  node.relation = Relation::kUnder;
  node.parent = partner.parent;
  node.pair = near;
  if (partner.pair) node.piece_of = partner.pair;
  if (!partner.pair) partner.pair = part;
}

void SetRole(DepthGraph& graph, int part, PartRole role) {
  DepthNode& node = graph.nodes[static_cast<Index>(part)];
  node.role = role;
  if (role == PartRole::kIgnored) {
    node.parent.reset();
    node.relation = Relation::kNone;
    return;
  }
  if (!node.parent) node.parent = graph.body;
  node.relation = role == PartRole::kForeground ? Relation::kOver : Relation::kAdjacent;
  PassOn(graph, part);
}

}  // namespace

Outcome<DepthGraph> ApplyOverrides(const Parts& parts, DepthGraph graph,
                                   const OrderByDepthOptions& options) {
  const auto refuse = [](const PartReference& reference, const std::string& what) {
    return Outcome<DepthGraph>::Failure(Refusal(reference, what));
  };
  for (const PartOverride& wanted : options.overrides) {
    const auto part = Find(parts, wanted.part);
    if (!part) return refuse(wanted.part, "which is not there; inspect shows the parts");
    if (wanted.flat) graph.nodes[static_cast<Index>(*part)].flat = true;
    if (!wanted.role) continue;
    if (*part == graph.body) return refuse(wanted.part, "which is the body; name another body");
    Unpair(graph, *part);
    if (*wanted.role != PartRole::kBackground) {
      SetRole(graph, *part, *wanted.role);
      continue;
    }
    const auto near = Find(parts, *wanted.near);
    if (!near || near == part ||
        graph.nodes[static_cast<Index>(*near)].role != PartRole::kForeground)
      return refuse(*wanted.near, "as a near side, which is not in the foreground");
    SetFar(graph, *part, *near);
  }
  return graph;
}

}  // namespace lascaux

#include "lascaux/sketch/depth_graph.h"

#include <algorithm>
#include <string>

#include "sketch/depth/adjacency.h"
#include "sketch/depth/apply_overrides.h"
#include "sketch/depth/body.h"
#include "sketch/depth/pairs.h"
#include "sketch/depth/place_cells.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Index = std::size_t;

/// A torso whose score is ahead of the next one's by less than this share is a guess.
constexpr double kSureMargin = 0.2;

/// A role that is ahead of the next one by less than this is a guess: a change of one limit of the
/// rules by a tenth would turn it.
constexpr double kSureRole = 0.1;

/// What lies apart from the animal is worth a word from this share of the torso's area on.
constexpr double kShowsApart = 0.02;

/// Open lines outside of the animal are worth one from this share of the drawing's diagonal on:
/// whiskers and blades of grass are less.
constexpr double kShowsLeftOut = 0.25;

/// Limbs lie over the part that they were cut from, their far sides under it.
void PlaceLimbs(const Parts& parts, const std::vector<std::optional<FarSide>>& far_sides,
                DepthGraph& graph) {
  for (Index i = 0; i < parts.parts.size(); ++i) {
    DepthNode& node = graph.nodes[i];
    if (parts.parts[i].kind == PartKind::kLimb) {
      node.role = PartRole::kForeground;
      node.parent = parts.parts[i].over;
      node.relation = Relation::kOver;
      const bool of_limb = parts.parts[static_cast<Index>(*node.parent)].kind == PartKind::kLimb;
      const PartRole left = of_limb                      ? PartRole::kForeground
                            : *node.parent == graph.body ? PartRole::kBody
                                                         : PartRole::kSagittal;
      node.choice = RoleChoice{parts.parts[i].score, left, 0};
      if (parts.parts[i].root->evidence == LimbEvidence::kOverride) node.choice.reset();
    } else if (far_sides[i]) {
      DepthNode& near = graph.nodes[static_cast<Index>(far_sides[i]->limb)];
      node.role = PartRole::kBackground;
      node.parent = parts.parts[static_cast<Index>(far_sides[i]->limb)].over;
      node.relation = Relation::kUnder;
      node.pair = far_sides[i]->limb;
      const double other = far_sides[i]->other_score;
      node.choice = RoleChoice{far_sides[i]->score,
                               other > 0 ? PartRole::kBackground : PartRole::kSagittal, other};
      if (near.pair) {
        node.piece_of = near.pair;
      } else {
        near.pair = static_cast<int>(i);
      }
    }
  }
}

/// Islands lie over and in the innermost part around them (§5.2: a ray cast); limbs are on top of
/// what they cover.
void PlaceIslands(const Parts& parts, DepthGraph& graph) {
  for (Index i = 0; i < parts.parts.size(); ++i) {
    DepthNode& node = graph.nodes[i];
    if (parts.parts[i].kind == PartKind::kInner) node.role = PartRole::kIgnored;
    if (parts.parts[i].kind != PartKind::kIsland) continue;
    const Vector2d at = Centroid(parts.parts[i].outline.points);
    std::optional<Index> around;
    for (Index k = 0; k < parts.parts.size(); ++k) {
      const Part& other = parts.parts[k];
      const bool solid = other.kind == PartKind::kBorder || other.kind == PartKind::kLimb;
      if (!solid || !Contains(other.outline.points, at)) continue;
      const bool inner = !around || SignedArea(other.outline.points) <
                                        SignedArea(parts.parts[*around].outline.points);
      if (inner) around = k;
    }
    const bool shows = around && graph.nodes[*around].role != PartRole::kBackground &&
                       graph.nodes[*around].role != PartRole::kIgnored;
    node.role = shows ? PartRole::kIsland : PartRole::kIgnored;
    if (!shows) continue;
    node.parent = static_cast<int>(*around);
    node.relation = Relation::kOverIn;
  }
}

/// Parts that hang on something which is not built are not built either.
void DropOrphans(DepthGraph& graph) {
  for (bool again = true; again;) {
    again = false;
    for (DepthNode& node : graph.nodes) {
      if (!node.parent || node.role == PartRole::kIgnored) continue;
      const PartRole role = graph.nodes[static_cast<Index>(*node.parent)].role;
      if (role != PartRole::kIgnored && role != PartRole::kBackground) continue;
      node = DepthNode{};
      node.role = PartRole::kIgnored;
      again = true;
    }
  }
}

void NameParts(DepthGraph& graph) {
  int limbs = 0;
  for (Index i = 0; i < graph.nodes.size(); ++i) {
    DepthNode& node = graph.nodes[i];
    const std::string id = std::to_string(i);
    switch (node.role) {
      case PartRole::kBody:
        node.name = "body";
        break;
      case PartRole::kForeground:
        node.name = "limb-" + std::to_string(++limbs);
        break;
      case PartRole::kIsland:
        node.name = "eye-" + id;
        break;
      default:
        node.name = "part-" + id;
    }
  }
  for (DepthNode& node : graph.nodes) {
    if (node.role == PartRole::kBackground && !node.piece_of)
      node.name = graph.nodes[static_cast<Index>(*node.pair)].name + "-far";
  }
}

/// Why a role is a guess, with its margin; empty for one that is sure.
std::string WhyGuessed(const Part& part, const DepthNode& node) {
  if (!node.choice) return "";
  char text[120] = "";
  const double margin = node.choice->Margin();
  const bool over = node.role == PartRole::kForeground && node.relation == Relation::kOver;
  if (over && part.kind == PartKind::kBorder) {
    std::snprintf(text, sizeof text, "is a closed cell, taken for one of a pair, by %.2f", margin);
  } else if (over && part.root->evidence == LimbEvidence::kFarSide) {
    std::snprintf(text, sizeof text, "was found by its far side alone, at %.2f of at most %.2f",
                  part.root->energy, kMostUnlikeFarSide);
  } else if (over && margin < kSureRole) {
    std::snprintf(text, sizeof text, "was taken for a limb by %.2f only", margin);
  } else if (node.role == PartRole::kSagittal && margin < kSureRole) {
    std::snprintf(text, sizeof text, "was taken for one in the plane, no pair, by %.2f only",
                  margin);
  }
  return text;
}

/// What was decided on little evidence, each at its place.
void WarnOfGuesses(const Parts& parts, const DepthGraph& graph, Diagnostics& log) {
  for (Index i = 0; i < graph.nodes.size(); ++i) {
    const std::string why = WhyGuessed(parts.parts[i], graph.nodes[i]);
    if (why.empty()) continue;
    log.push_back(
        At(Warning("limb-guessed", graph.nodes[i].name + " " + why + "; --overrides corrects it"),
           Centroid(parts.parts[i].outline.points)));
  }
}

/// Closed outlines that touch the animal nowhere: a second animal, or a tail's tuft.
void WarnOfOthers(const Parts& parts, const DepthGraph& graph, Diagnostics& log) {
  const auto area = [&](Index i) { return SignedArea(parts.parts[i].outline.points); };
  const double body = area(static_cast<Index>(graph.body));
  for (Index i = 0; i < graph.nodes.size(); ++i) {
    const bool left_out =
        graph.nodes[i].role == PartRole::kIgnored && parts.parts[i].kind == PartKind::kBorder;
    if (!left_out || area(i) < kShowsApart * body) continue;
    char text[200];
    std::snprintf(
        text, sizeof text,
        "a closed outline of %.0f %% of the torso's area touches the animal nowhere and is "
        "not built; join it, or give each animal a file of its own",
        100 * area(i) / body);
    log.push_back(At(Warning("outline-apart", text), Centroid(parts.parts[i].outline.points)));
  }
}

/// Open lines outside of all that is built: a head whose outline does not close, antlers, whiskers.
void WarnOfLinesLeftOut(const PlanarMap& map, const Parts& parts, const DepthGraph& graph,
                        Diagnostics& log) {
  const auto is_built_around = [&](const Eigen::Vector2d& point) {
    for (Index i = 0; i < graph.nodes.size(); ++i) {
      if (graph.nodes[i].role != PartRole::kIgnored &&
          Contains(parts.parts[i].outline.points, point))
        return true;
    }
    return false;
  };
  double total = 0, longest = 0;
  Eigen::Vector2d place(0, 0);
  for (int half_edge = 0; half_edge < static_cast<int>(map.cycle.size()); half_edge += 2) {
    const Index h = static_cast<Index>(half_edge);
    if (map.cycle[h] != map.cycle[h + 1]) continue;  // it encloses something
    const std::vector<Eigen::Vector2d> points = map.Points(half_edge);
    const Eigen::Vector2d middle = points[points.size() / 2];
    if (is_built_around(middle)) continue;
    double length = 0;
    for (Index i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    total += length;
    if (length > longest) longest = length, place = middle;
  }
  if (total < kShowsLeftOut * map.diagonal) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "open lines, %.0f %% of the drawing's size in all, lie outside of what is built; "
                "what belongs to the animal must be enclosed: let the ends meet",
                100 * total / map.diagonal);
  log.push_back(At(Warning("lines-left-out", text), place));
}

void OrderParentsFirst(DepthGraph& graph) {
  std::vector<bool> done(graph.nodes.size(), false);
  for (bool again = true; again;) {
    again = false;
    for (Index i = 0; i < graph.nodes.size(); ++i) {
      const DepthNode& node = graph.nodes[i];
      if (done[i] || node.role == PartRole::kIgnored ||
          (node.parent && !done[static_cast<Index>(*node.parent)]))
        continue;
      done[i] = again = true;
      graph.order.push_back(static_cast<int>(i));
    }
  }
}

}  // namespace

Outcome<DepthGraph> OrderByDepth(const PlanarMap& map, const Parts& parts,
                                 const OrderByDepthOptions& options, const Execution&) {
  const Adjacency adjacency = AdjacencyOf(map, parts);
  Diagnostics log;
  const auto body = FindBody(parts, adjacency, options).MoveInto(log);
  if (!body) return Outcome<DepthGraph>::Failure(std::move(log));
  if (body->margin < kSureMargin && !options.body && !options.body_part) {
    char text[120];
    std::snprintf(text, sizeof text,
                  "the torso is ahead of the next part by %.0f %% only; --body X,Y decides",
                  100 * body->margin);
    log.push_back(At(Warning("body-unsure", text),
                     Centroid(parts.parts[static_cast<Index>(body->part)].outline.points)));
  }
  DepthGraph graph;
  graph.nodes.resize(parts.parts.size());
  graph.body = body->part;
  graph.body_margin = body->margin;
  PlaceLimbs(parts, FindFarSides(map, parts, adjacency, graph.body), graph);
  DepthNode& torso = graph.nodes[static_cast<Index>(graph.body)];
  torso = DepthNode{};
  torso.role = PartRole::kBody;
  if (!options.body && !options.body_part)
    torso.choice = RoleChoice{1, PartRole::kSagittal, 1 - body->margin};
  PlaceCells(map, parts, adjacency, graph);
  PlaceIslands(parts, graph);
  auto corrected = ApplyOverrides(parts, std::move(graph), options).MoveInto(log);
  if (!corrected) return Outcome<DepthGraph>::Failure(std::move(log));
  graph = std::move(*corrected);
  WarnOfOthers(parts, graph, log);
  DropOrphans(graph);
  NameParts(graph);
  WarnOfGuesses(parts, graph, log);
  WarnOfLinesLeftOut(map, parts, graph, log);
  OrderParentsFirst(graph);
  return {std::move(graph), std::move(log)};
}

const char* Name(PartRole role) noexcept {
  switch (role) {
    case PartRole::kBody:
      return "body";
    case PartRole::kForeground:
      return "foreground";
    case PartRole::kBackground:
      return "background";
    case PartRole::kSagittal:
      return "sagittal";
    case PartRole::kIsland:
      return "island";
    case PartRole::kIgnored:
      break;
  }
  return "ignored";
}

const char* Name(Relation relation) noexcept {
  switch (relation) {
    case Relation::kOver:
      return "over";
    case Relation::kUnder:
      return "under";
    case Relation::kAdjacent:
      return "adjacent";
    case Relation::kOverIn:
      return "over-in";
    case Relation::kNone:
      break;
  }
  return "none";
}

}  // namespace lascaux

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"
#include "lascaux/sketch/planar_map.h"

/// @file
/// What every map, its parts and their graph must be, whatever was drawn; for tests and the fuzzer.

namespace lascaux::testing {

/// What is wrong with a planar map; empty when nothing is.
inline std::string WrongWith(const PlanarMap& map) {
  const int half_edges = static_cast<int>(2 * map.edges.size());
  const auto size = [](const auto& list) { return static_cast<int>(list.size()); };
  if (size(map.next) != half_edges || size(map.cycle) != half_edges) return "half-edges of no edge";
  std::vector<int> before(map.next.size(), 0);
  for (int h = 0; h < half_edges; ++h) {
    const int next = map.next[static_cast<std::size_t>(h)];
    if (next < 0 || next >= half_edges) return "a next half-edge that is none";
    if (map.Origin(next) != map.Target(h)) return "a next half-edge elsewhere";
    if (map.cycle[static_cast<std::size_t>(next)] != map.cycle[static_cast<std::size_t>(h)])
      return "a walk through two cycles";
    ++before[static_cast<std::size_t>(next)];
  }
  if (std::any_of(before.begin(), before.end(), [](int n) { return n != 1; }))
    return "half-edges that are not followed once";
  for (const MapEdge& edge : map.edges) {
    if (edge.points.size() < 2) return "an edge without length";
    for (const Eigen::Vector2d& p : edge.points) {
      if (!p.allFinite()) return "a point that is not finite";
    }
    if (edge.points.front() != map.nodes[static_cast<std::size_t>(edge.nodes[0])].position ||
        edge.points.back() != map.nodes[static_cast<std::size_t>(edge.nodes[1])].position)
      return "an edge that ends beside its node";
  }
  std::size_t walked = 0;
  for (const MapCycle& cycle : map.cycles) {
    walked += cycle.half_edges.size();
    const bool bounded = cycle.kind == CycleKind::kBorder || cycle.kind == CycleKind::kIsland ||
                         cycle.kind == CycleKind::kOther;
    if (bounded != (cycle.area > 0)) return "a face with the other sign";
    if (cycle.inside && (*cycle.inside < 0 || *cycle.inside >= size(map.cycles)))
      return "a cycle inside of none";
  }
  if (walked != map.next.size()) return "half-edges in no cycle";
  return {};
}

/// What is wrong with the parts of a map; empty when nothing is.
inline std::string WrongWith(const Parts& parts) {
  const int count = static_cast<int>(parts.parts.size());
  for (int i = 0; i < count; ++i) {
    const Part& part = parts.parts[static_cast<std::size_t>(i)];
    if (part.outline.points.size() != part.outline.kinds.size()) return "pieces without a kind";
    for (const Eigen::Vector2d& p : part.outline.points) {
      if (!p.allFinite()) return "an outline that is not finite";
    }
    if ((part.kind == PartKind::kLimb) != part.over.has_value()) return "a limb over nothing";
    if ((part.kind == PartKind::kLimb) != part.root.has_value()) return "a limb without a root";
    if (part.over && (*part.over < 0 || *part.over >= i)) return "a limb before its parent";
    if (part.far_side_of && (*part.far_side_of < 0 || *part.far_side_of >= count))
      return "a far side of nothing";
  }
  return {};
}

/// What is wrong with the graph of some parts; empty when nothing is.
inline std::string WrongWith(const DepthGraph& graph, const Parts& parts) {
  const int count = static_cast<int>(parts.parts.size());
  if (static_cast<int>(graph.nodes.size()) != count) return "nodes of no part";
  if (graph.body < 0 || graph.body >= count) return "a body that is no part";
  std::vector<bool> placed(parts.parts.size(), false);
  for (const int i : graph.order) {
    const DepthNode& node = graph.nodes[static_cast<std::size_t>(i)];
    if (node.role == PartRole::kIgnored) return "an ignored part in the order";
    if ((i == graph.body) == node.parent.has_value()) return "a part without a parent";
    if (node.parent && !placed[static_cast<std::size_t>(*node.parent)])
      return "a part before its parent";
    placed[static_cast<std::size_t>(i)] = true;
  }
  for (int i = 0; i < count; ++i) {
    const bool wanted = graph.nodes[static_cast<std::size_t>(i)].role != PartRole::kIgnored;
    if (wanted != placed[static_cast<std::size_t>(i)]) return "a part that is not in the order";
  }
  return {};
}

/// Everything between a drawing and its skeletons; what is wrong there, empty when nothing is.
inline std::string WrongWithStructureOf(const Sketch& sketch) {
  const auto map = BuildPlanarMap(sketch);
  if (!map) return HasError(map.diagnostics()) ? "" : "no map and no error";
  if (const std::string wrong = WrongWith(*map); !wrong.empty()) return wrong;
  const auto parts = FindParts(*map);
  if (!parts) return "no parts";
  if (const std::string wrong = WrongWith(*parts); !wrong.empty()) return wrong;
  const auto graph = OrderByDepth(*map, *parts);
  if (!graph) return HasError(graph.diagnostics()) ? "" : "no graph and no error";
  return WrongWith(*graph, *parts);
}

/// A drawing from any bytes, on a grid of 256 by 256 so that lines often touch, overlap and end on
/// each other. For each stroke a byte with its kind (bit 7: a dot; bit 6: closed; bit 5: of curves)
/// and its pieces (the rest, at least one), then the coordinates of the start and of each piece's
/// points.
inline Sketch SketchFrom(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostStrokes = 60;
  std::size_t at = 0;
  const auto next = [&] { return at < size ? static_cast<double>(data[at++]) : 0.0; };
  const auto point = [&] {
    const double x = next();
    return Eigen::Vector2d(x, next());
  };
  Sketch sketch;
  while (at < size && sketch.strokes.size() < kMostStrokes) {
    const unsigned head = data[at++];
    Stroke stroke;
    stroke.width = 1;
    Eigen::Vector2d pen = point();
    const Eigen::Vector2d start = pen;
    stroke.is_dot = (head & 0x80u) != 0;
    if (stroke.is_dot) {
      stroke.width = 4;
      stroke.pieces.push_back({{pen, pen, pen, pen}});
    }
    for (unsigned k = 0; k < 1 + (head & 0x1Fu) && !stroke.is_dot && at < size; ++k) {
      CubicBezier piece;
      if ((head & 0x20u) != 0) {
        const Eigen::Vector2d a = point(), b = point();
        piece = {{pen, a, b, point()}};
      } else {
        piece = Line(pen, point());
      }
      const bool has_length = std::any_of(piece.p.begin(), piece.p.end(),
                                          [&](const Eigen::Vector2d& p) { return p != pen; });
      pen = piece.p[3];
      if (has_length) stroke.pieces.push_back(piece);
    }
    if (stroke.pieces.empty()) continue;
    if ((head & 0x40u) != 0 && !stroke.is_dot) {
      if (pen != start) stroke.pieces.push_back(Line(pen, start));
      stroke.closed = true;
    }
    sketch.strokes.push_back(std::move(stroke));
  }
  return sketch;
}

}  // namespace lascaux::testing

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/sketch/sketch.h"

/// @file
/// The planar map of a drawing: its curves as half-edges, joined at nodes, decomposed into cycles.
///
/// Source: Entem et al. 2015, section 4.1.

namespace lascaux {

/// A place where edges meet or end.
struct MapNode {
  Eigen::Vector2d position;
  std::vector<int>
      outgoing;  ///< half-edges that begin here, by ascending angle in the sketch frame

  bool operator==(const MapNode&) const = default;
};

/// A piece of a stroke between two nodes. Half-edge 2e runs along `points`, half-edge 2e + 1
/// against them.
struct MapEdge {
  std::vector<Eigen::Vector2d>
      points;  ///< flattened curve, both nodes included, no two in a row equal
  Eigen::Vector2d start_tangent,
      end_tangent;             ///< unit, of the curve itself, in the direction of `points`
  int stroke = -1;             ///< the stroke that it is a piece of; -1 for a closure of a gap
  std::array<int, 2> nodes{};  ///< where it begins and ends

  bool operator==(const MapEdge&) const = default;
};

/// What a cycle is, by the paper's names.
enum class CycleKind : std::uint8_t {
  kOuter,   ///< the outer sketch cycle, and the outside of pieces that float outside of everything
  kBorder,  ///< a bounded face that shares an edge with the outside
  kIsland,  ///< a bounded face of a component that lies inside another face and touches nothing
            ///< else
  kOther,   ///< any other bounded face
  kHole,    ///< the outside of a component that lies inside a face: no face of its own
};

/// A closed walk along half-edges, the face on one side of it.
struct MapCycle {
  CycleKind kind = CycleKind::kOther;
  std::vector<int> half_edges;
  double area = 0;  ///< signed shoelace in the sketch frame; positive for bounded faces
  std::optional<int>
      inside;  ///< for islands and holes: the bounded cycle that the component lies in

  bool operator==(const MapCycle&) const = default;
};

/// The half-edge structure. `next`, `cycle` have one entry a half-edge.
struct PlanarMap {
  std::vector<MapNode> nodes;
  std::vector<MapEdge> edges;
  std::vector<int> next;
  std::vector<int> cycle;
  std::vector<MapCycle> cycles;
  double diagonal = 0;  ///< of the drawing's bounds, the unit of all relative lengths

  static int Twin(int half_edge) { return half_edge ^ 1; }
  int Origin(int half_edge) const;
  int Target(int half_edge) const { return Origin(Twin(half_edge)); }
  /// Points along the half-edge, in its direction.
  std::vector<Eigen::Vector2d> Points(int half_edge) const;
  /// Unit direction in which the half-edge leaves its origin, and in which it arrives at its
  /// target.
  Eigen::Vector2d Departure(int half_edge) const;
  Eigen::Vector2d Arrival(int half_edge) const;

  bool operator==(const PlanarMap&) const = default;
};

/// How to join strokes. Lengths are relative to the diagonal D of the drawing's bounds.
struct BuildPlanarMapOptions {
  double flatten = 1e-4;  ///< how far the flattened curves may be from the curves
  double snap = 5e-3;  ///< ends this near to another stroke meet it; one pen width if that is more,
                       ///< up to snap_max
  double snap_max = 1.5e-2;
  double bridge = 3e-2;              ///< longest gap that is closed, with a warning
  double bridge_max = 0.08;          ///< the same where the lines don't enclose an animal otherwise
  std::vector<int> ignored_strokes;  ///< indices in Sketch::strokes of lines to leave out

  bool operator==(const BuildPlanarMapOptions&) const = default;
};

/// Joins the strokes of a drawing into a planar map.
///
/// A number in options.ignored_strokes that no stroke has is the error "override-not-there"
/// (usage).
///
/// Warnings: "gap-closed", "slit-closed" with their places. Notes: "cell-merged". Errors:
/// "no-strokes" (input); "outline-open" with the place, "too-tangled", "too-many-strokes"
/// (understanding). Time: n log n in the points of a drawing, and linear in its crossings; 2 ms for
/// a drawing of 20 strokes.
Outcome<PlanarMap> BuildPlanarMap(const Sketch& sketch, const BuildPlanarMapOptions& options = {},
                                  const Execution& execution = {});

}  // namespace lascaux

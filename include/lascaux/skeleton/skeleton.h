#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"

/// @file
/// Skeletons: pruned and simplified medial axes of part outlines.
///
/// Source: Entem et al. 2015, section 6.1; S. Fortune, "A sweepline algorithm for Voronoi
/// diagrams", Algorithmica 2, 1987; J. Giesen, B. Miklos, M. Pauly, C. Wormser, "The Scale Axis
/// Transform", SoCG 2009. We differ from the second in that the axis stays a tree: where grown
/// discs would close a bay of the outline, no loop appears.

namespace lascaux {

/// A disc of the medial axis, in sketch units.
struct SkeletonVertex {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double radius = 0;

  bool operator==(const SkeletonVertex&) const = default;
};

/// A tree of discs: the radius varies linearly along an edge. At least one vertex; a single one is
/// a disc.
struct Skeleton {
  int part = 0;
  std::vector<SkeletonVertex> vertices;
  std::vector<std::array<int, 2>> edges;

  bool operator==(const Skeleton&) const = default;
};

struct ExtractSkeletonsOptions {
  double scale_axis = 1.2;         ///< factor of the scale axis transform (the paper's value), > 1
  double simplify = 0.1;           ///< tolerance of the simplification, in median radii of the part
  double sample_spacing = 2.5e-3;  ///< of the outline, relative to the diagonal of all outlines

  bool operator==(const ExtractSkeletonsOptions&) const = default;
};

/// Skeletons of all parts that are built, in the order of the parts: those that are neither
/// background nor ignored and whose ancestors in the graph are built too.
///
/// Outlines that only abut their parent's are first extended into it by half the joint's width,
/// tangent-continuous. Each outline is sampled evenly (finer where it is thin), the Voronoi diagram
/// of the samples cut to the inside, pruned by the scale axis transform, and simplified until the
/// next vertex to go would move the outline of the discs by more than the tolerance. A circle
/// becomes one disc. Radii are > 0; positions lie inside the outline. Cost: O(n log n) for n
/// samples; a creature of ten parts takes about 10 ms on one core.
///
/// Errors: "degenerate-outline" when an outline encloses no area or is not finite. Notes:
/// "part-not-built" for a part whose parent is not built.
Outcome<std::vector<Skeleton>> ExtractSkeletons(const Parts& parts, const DepthGraph& graph,
                                                const ExtractSkeletonsOptions& options = {},
                                                const Execution& execution = {});

}  // namespace lascaux

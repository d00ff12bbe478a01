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
/// Source: Entem et al. 2015, section 6.1; Giesen, Miklos, Pauly, Wormser, "The Scale Axis Transform", SoCG 2009.

namespace lascaux {

/// A disc of the medial axis, in sketch units.
struct SkeletonVertex {
  Eigen::Vector2d position;
  double radius = 0;

  bool operator==(const SkeletonVertex&) const = default;
};

/// A tree of discs: the radius varies linearly along an edge. At least one vertex; a single one is a disc.
struct Skeleton {
  int part = 0;
  std::vector<SkeletonVertex> vertices;
  std::vector<std::array<int, 2>> edges;

  bool operator==(const Skeleton&) const = default;
};

struct ExtractSkeletonsOptions {
  double scale_axis = 1.2;            ///< factor of the scale axis transform (the paper's value)
  double simplify = 0.1;              ///< tolerance of the simplification, in median radii of the part
  double sample_spacing = 2.5e-3;     ///< of the outline, relative to the drawing's diagonal

  bool operator==(const ExtractSkeletonsOptions&) const = default;
};

/// Skeletons of all parts that are built: one for each that is neither background nor ignored, in the order of
/// the parts. Outlines of parts that only abut their parent are extended into it first.
Outcome<std::vector<Skeleton>> ExtractSkeletons(const Parts& parts, const DepthGraph& graph,
                                                const ExtractSkeletonsOptions& options = {},
                                                const Execution& execution = {});

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"

/// @file
/// The outline that the side view of the model is to have.

namespace lascaux {

/// Drawn pieces of outlines on the boundary of the union of all parts that are built, sampled at
/// most `spacing` (sketch units) apart: runs of consecutive points, in sketch units. Far limbs are
/// not built: lines before them are boundary.
std::vector<std::vector<Eigen::Vector2d>> UnionOutline(const Parts& parts, const DepthGraph& graph,
                                                       double spacing);

/// Smallest box around the outlines of all parts that are built.
Eigen::AlignedBox2d BuiltBox(const Parts& parts, const DepthGraph& graph);

}  // namespace lascaux

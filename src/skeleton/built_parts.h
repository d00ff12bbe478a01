#pragma once

#include <vector>

#include "lascaux/sketch/depth_graph.h"

/// @file
/// Which parts get a skeleton.

namespace lascaux {

/// For each part whether it is built: neither background nor ignored, and all of its ancestors are
/// built.
std::vector<char> BuiltParts(const DepthGraph& graph);

}  // namespace lascaux

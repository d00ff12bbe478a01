#pragma once

#include "lascaux/sketch/depth_graph.h"

/// @file
/// What somebody says of single parts, against the rules.

namespace lascaux {

/// The graph with options.overrides applied, in their order. What hangs on a part follows it: more
/// of a limb that lies in the plane lies in the plane. Errors: "override-not-there"
/// (understanding).
Outcome<DepthGraph> ApplyOverrides(const Parts& parts, DepthGraph graph,
                                   const OrderByDepthOptions& options);

}  // namespace lascaux

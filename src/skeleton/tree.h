#pragma once

#include <vector>

#include "lascaux/skeleton/skeleton.h"

/// @file
/// Walking the trees that skeletons are.

namespace lascaux {

/// For each vertex the vertices that it shares an edge with, in the order of the edges.
std::vector<std::vector<int>> Neighbours(const Skeleton& tree);

/// The vertices with keep[v] != 0 and the edges between them, order kept.
Skeleton Subtree(const Skeleton& tree, const std::vector<char>& keep);

/// Maximal paths whose inner vertices have exactly two neighbours; each vertex of another degree
/// ends the paths that reach it. Empty for a single vertex.
std::vector<std::vector<int>> Paths(const Skeleton& tree);

}  // namespace lascaux

#pragma once

#include "lascaux/skeleton/skeleton.h"

/// @file
/// Simplification of skeletons by what it does to the outline of their discs.
///
/// Source: Entem et al. 2015, section 6.1 (Douglas-Peucker with the outline's distance as cost).

namespace lascaux {

/// Signed distance from `point` to the hull of the discs `a` and `b`, negative inside.
double DistanceToCone(const SkeletonVertex& a, const SkeletonVertex& b,
                      const Eigen::Vector2d& point);

/// Fewest vertices by greedy removal, cheapest first: a vertex's cost is the largest distance
/// between the outline of the original discs around it and the hull of the two discs that would be
/// joined. Stops at `tolerance` median radii; discs of less than half the median have their
/// tolerance from their own diameter, lest tips go coarse.
///
/// Leaves and branch vertices stay, but a branch all of whose discs reach out of the others by at
/// most half of the tolerance goes first, and a tree that one of its discs covers to 2 % becomes
/// that disc.
Skeleton Simplify(const Skeleton& axis, double tolerance);

}  // namespace lascaux

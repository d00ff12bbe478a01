#pragma once

#include <vector>

#include "lascaux/field/field.h"
#include "lascaux/skeleton/creature.h"

/// @file
/// Chains: how a tree of discs becomes polylines, and polylines fields.

namespace lascaux {

/// The cap that makes the end of a chain round: raw integrals end three quarters of a radius short.
/// The end vertex moves outwards by kCapShift radii, and a point of kCapRadius radii and weight
/// kCapWeight is added there. Least-squares fit to a half sphere at the end of a long cylinder; the
/// worst error is 0.0144 radii, and 0.035 for chains shorter than a radius.
inline constexpr double kCapShift = 0.1389;
inline constexpr double kCapRadius = 0.7659;
inline constexpr double kCapWeight = 0.9925;

/// The tree as chains, the longest path first, then the longest path that hangs on those before,
/// until every edge is in exactly one. Later chains begin at the vertex that they branch off from.
/// Length counts the discs at the ends.
std::vector<Chain> CutIntoChains(const Skeleton& tree);

/// The same discs with more of them, so that no edge is longer than its mean radius, which gives
/// the fit a vertex for each swelling that the field can show. No radius is below 1e-3 of the
/// largest: a field has no limit at a tip of radius 0.
///
/// Radii stay those of the outline. Correcting them for the slope g by 1 / (1 + 0.4 g^2), which is
/// right for a pure cone, made most parts of real outlines worse before the fit: their slopes
/// are steep at ends, where a cone's law does not hold.
Chain Refined(const Chain& chain);

/// Unit vector from the vertex next to `end` (0 or the last) to it; x for a chain without length.
Eigen::Vector2d EndDirection(const Chain& chain, std::size_t end);

/// The chain's field in the plane at depth `z` of a space whose lengths are the frame's; a single
/// vertex is a ball.
FieldChain MakeFieldChain(const Chain& chain, const ModelFrame& frame, double z);

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <optional>

#include "sketch/map/outer_walk.h"

/// @file
/// Slits: where lines run side by side so near each other that they may be meant to touch.

namespace lascaux {

/// A bridge across a slit; it begins at the left.
struct Slit {
  Eigen::Vector2d from, to;
  double width = 0;
};

/// What is taken for a slit, and which are worth closing.
struct SlitSearch {
  double reach = 0;        ///< widest slit, in sketch units
  double least_along = 0;  ///< shortest way around the walk between its two sides
  double least_area = 0;   ///< smallest face that closing it encloses, in square units
};

/// The narrowest slit of a walk; among equally narrow ones the first along the walk. n log n in the
/// walk's points as long as its lines are not much denser than `reach`.
std::optional<Slit> NarrowestSlit(const OuterWalk& walk, const SlitSearch& search);

}  // namespace lascaux

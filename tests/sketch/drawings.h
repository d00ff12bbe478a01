#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "lascaux/sketch/planar_map.h"
#include "lascaux/sketch/sketch.h"

/// @file
/// Small drawings made by hand, for tests of the structure stages.

namespace lascaux::testing {

using Points = std::vector<Eigen::Vector2d>;

/// A stroke of straight pieces through the points.
Stroke Straight(const Points& points);
/// A closed stroke of straight pieces.
Stroke Loop(Points points);
/// A circle of four cubic Béziers.
Stroke Circle(const Eigen::Vector2d& center, double radius);

/// How many of a map's cycles are of this kind.
int Count(const PlanarMap& map, CycleKind kind);

Sketch SketchOf(std::initializer_list<Stroke> strokes);

/// All points taken through p -> scale * p + shift.
Sketch Moved(Sketch sketch, double scale, const Eigen::Vector2d& shift);
/// The mirror image in x, about x = 0.
Sketch Mirrored(Sketch sketch);

/// A torso 400 x 160 with a near leg between two suggestive curves, a far leg behind it, a tail
/// cell at the right and an eye: strokes meet exactly. The near leg's closed ends are (100, 200)
/// and (150, 200), its open ends (105, 130) and (145, 130).
Sketch Quadruped();

}  // namespace lascaux::testing

#pragma once

#include <array>
#include <cstdint>

#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"

/// @file
/// Outlines whose medial axes are known, and a small creature.

namespace lascaux::testing {

/// An outline of drawn pieces through the points, in the orientation that Outline asks for.
Outline Drawn(std::vector<Eigen::Vector2d> points);

Outline Ellipse(const Eigen::Vector2d& center, double a, double b);

/// The hull of two discs of one radius.
Outline Capsule(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius);

/// A corner of the given opening, in radians, at the origin, its sides 3 long and closed by an arc
/// around (3, 0).
Outline Wedge(double opening);

/// A pointed ear, 2 wide and 3 high, tip at (0, -3).
Outline Ear();

/// A leg with a knee and a foot, about 1 wide and 6 high.
Outline Leg();

/// A body lying, the hull of two discs of radius 1 around (-4, 0) and (4, 0), with a leg 1.4 wide
/// down to y = 5, and where they meet.
Outline Crotches();
inline const std::array<Eigen::Vector2d, 2> kCrotches{Eigen::Vector2d(0.7, 1),
                                                      Eigen::Vector2d(-0.7, 1)};

/// A random smooth star: radius 1 plus four harmonics.
Outline RandomBlob(std::uint32_t seed);

/// One part that is the body.
struct Drawing {
  Parts parts;
  DepthGraph graph;

  /// Adds a part and its node; returns its index. A part without a parent is the body.
  int Add(Outline outline, PartRole role, std::optional<int> parent = {});
};
Drawing OnlyBody(Outline outline);

/// Indices of the parts of MakeBeast().
enum Beast { kBody, kFrontLeg, kHindLeg, kEye, kTail, kHoof, kFarLeg };

/// A body (an ellipse 8 by 3), two legs over it, an eye on it, a tail that abuts it, a hoof that
/// abuts the front leg, and a far leg.
Drawing MakeBeast();

}  // namespace lascaux::testing

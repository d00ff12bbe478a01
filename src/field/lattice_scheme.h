#pragma once

/// @file
/// Where a block's lattice is evaluated to interpolate the rest; part of the vector code, so plain
/// numbers.

namespace lascaux::internal {

/// Points of a block's lattice along each axis.
inline constexpr int kLatticeSide = 8;
inline constexpr int kLatticePoints = kLatticeSide * kLatticeSide * kLatticeSide;

/// A product of as many nodes along each axis, and points off the nodes that show how well these
/// tell the rest: first so many along each axis on lines of nodes, then those off them along all
/// three. In steps from the lattice's first point.
struct LatticeScheme {
  static constexpr int kMostChecks = 32;

  int side;
  float nodes[4];
  int checks, checks_an_axis;
  float check_at[kMostChecks][3];

  constexpr int points() const { return side * side * side; }
};

/// Polynomials of degree 3: nodes near Chebyshev's among the lattice's own points, every other line
/// of them along each axis with a check, at each place off the nodes as often.
constexpr LatticeScheme MakeCubicScheme() {
  LatticeScheme scheme{4, {0, 2, 5, 7}, 32, 8, {}};
  constexpr float kOff[4] = {1, 3, 4, 6};
  int check = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int u = 0; u < 4; ++u) {
      for (int w = u % 2; w < 4; w += 2) {
        float* const at = scheme.check_at[check++];
        at[axis] = kOff[(u + w / 2 * 2) % 4];
        at[(axis + 1) % 3] = scheme.nodes[u];
        at[(axis + 2) % 3] = scheme.nodes[w];
      }
    }
  }
  for (int corner = 0; corner < 8; ++corner, ++check) {
    for (int axis = 0; axis < 3; ++axis)
      scheme.check_at[check][axis] = kOff[1 + (corner >> axis & 1)];
  }
  return scheme;
}

/// Polynomials of degree 2: as many points, checks included, as half of the other's. The middle
/// line and four at the edges along each axis have a check.
constexpr LatticeScheme MakeQuadraticScheme() {
  LatticeScheme scheme{3, {0.5F, 3.5F, 6.5F}, 21, 5, {}};
  constexpr float kOff[4] = {0, 5, 2, 7};
  int check = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int line = 0; line < 5; ++line) {
      float* const at = scheme.check_at[check++];
      at[axis] = kOff[line % 4];
      at[(axis + 1) % 3] = scheme.nodes[line == 4 ? 1 : line % 2 * 2];
      at[(axis + 2) % 3] = scheme.nodes[line == 4 ? 1 : line / 2 * 2];
    }
  }
  // Four corners, no two of which share an edge, and two places in the middle.
  constexpr float kCorners[6][3] = {{0, 0, 0}, {7, 0, 7}, {0, 7, 7},
                                    {7, 7, 0}, {2, 5, 2}, {5, 2, 5}};
  for (const auto& corner : kCorners) {
    for (int axis = 0; axis < 3; ++axis) scheme.check_at[check][axis] = corner[axis];
    ++check;
  }
  return scheme;
}

inline constexpr LatticeScheme kCubicScheme = MakeCubicScheme(),
                               kQuadraticScheme = MakeQuadraticScheme();

}  // namespace lascaux::internal

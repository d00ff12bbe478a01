#pragma once

#include <Eigen/Core>
#include <optional>

#include "lascaux/sketch/bezier.h"
#include "sketch/map/polyline.h"

/// @file
/// Completions: the cubic Béziers that close parts where the drawing leaves them open (§4.2, eq.
/// 1).

namespace lascaux {

/// An end that a completion starts from or arrives at.
struct CompletionEnd {
  Eigen::Vector2d point;
  Eigen::Vector2d
      direction;  ///< unit, out of the drawn curve: the completion leaves the end this way
};

struct Completion {
  CubicBezier curve;
  double energy = 0;  ///< l times the sum of |k_{i+1} - k_i| along it: no unit, no scale
};

/// l times the total variation of curvature, from 24 even parameters. The paper's l^2 E (1/length)
/// changes with scale; this does not.
double CurvatureVariation(const CubicBezier& curve);

/// The C1 cubic between two ends with the least energy, handles between 0.1 and 1 chord.
Completion Complete(const CompletionEnd& from, const CompletionEnd& to);

/// The same curve as a polyline that stays inside `ring`: handles shortened until it does, else the
/// chord.
Polyline CompleteInside(const CompletionEnd& from, const CompletionEnd& to, const Polyline& ring);

}  // namespace lascaux

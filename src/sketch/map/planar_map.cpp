#include "lascaux/sketch/planar_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "sketch/map/arrangement.h"
#include "sketch/map/cells.h"
#include "sketch/map/gaps.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// More strokes than this are hatching, not an animal; the stages after this one would take
/// seconds.
constexpr std::size_t kMaxLines = 20'000;

Polyline FlattenStroke(const Stroke& stroke, double tolerance) {
  Polyline points;
  for (const CubicBezier& piece : stroke.pieces) {
    for (const CurveSample& sample : Flatten(piece, tolerance)) Append(points, {sample.point});
  }
  return points;
}

/// A dot (an eye, often) is the disc that the pen leaves.
Polyline Circle(const Vector2d& center, double radius) {
  constexpr int kSides = 48;
  Polyline points;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    points.push_back(center + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  points.push_back(points.front());
  return points;
}

std::vector<ArrangementLine> LinesOf(const Sketch& sketch, double diagonal,
                                     const BuildPlanarMapOptions& options) {
  std::vector<ArrangementLine> lines;
  for (std::size_t i = 0; i < sketch.strokes.size(); ++i) {
    const Stroke& stroke = sketch.strokes[i];
    const auto& ignored = options.ignored_strokes;
    if (std::find(ignored.begin(), ignored.end(), static_cast<int>(i)) != ignored.end()) continue;
    ArrangementLine line;
    line.points = stroke.is_dot ? Circle(stroke.pieces.front().p[0], 0.5 * stroke.width)
                                : FlattenStroke(stroke, options.flatten * diagonal);
    if (line.points.size() < 2) continue;
    line.stroke = static_cast<int>(i);
    line.closed = line.points.size() > 2 && line.points.front() == line.points.back();
    line.snap = std::clamp(stroke.width, options.snap * diagonal, options.snap_max * diagonal);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

int PlanarMap::Origin(int half_edge) const {
  return edges[static_cast<std::size_t>(half_edge / 2)]
      .nodes[static_cast<std::size_t>(half_edge % 2)];
}

std::vector<Vector2d> PlanarMap::Points(int half_edge) const {
  std::vector<Vector2d> points = edges[static_cast<std::size_t>(half_edge / 2)].points;
  if (half_edge % 2 == 1) std::reverse(points.begin(), points.end());
  return points;
}

Vector2d PlanarMap::Departure(int half_edge) const {
  const MapEdge& edge = edges[static_cast<std::size_t>(half_edge / 2)];
  return half_edge % 2 == 0 ? edge.start_tangent : Vector2d(-edge.end_tangent);
}

Vector2d PlanarMap::Arrival(int half_edge) const { return -Departure(Twin(half_edge)); }

Outcome<PlanarMap> BuildPlanarMap(const Sketch& sketch, const BuildPlanarMapOptions& options,
                                  const Execution&) {
  for (const int stroke : options.ignored_strokes) {
    if (stroke >= 0 && stroke < static_cast<int>(sketch.strokes.size())) continue;
    return Outcome<PlanarMap>::Failure(
        Error(FailureKind::kUnderstanding, "override-not-there",
              "there is no stroke " + std::to_string(stroke) + " to ignore; the drawing has 0 to " +
                  std::to_string(static_cast<int>(sketch.strokes.size()) - 1)));
  }
  const double diagonal = sketch.strokes.empty() ? 0 : Bounds(sketch).diagonal().norm();
  const std::vector<ArrangementLine> drawn = LinesOf(sketch, diagonal, options);
  if (drawn.empty() || !(diagonal > 0)) {
    return Outcome<PlanarMap>::Failure(
        Error(FailureKind::kInput, "no-strokes",
              "the drawing has no line that encloses anything; draw the animal's outline"));
  }
  if (drawn.size() > kMaxLines) {
    return Outcome<PlanarMap>::Failure(
        Error(FailureKind::kUnderstanding, "too-many-strokes",
              "the drawing has " + std::to_string(drawn.size()) + " strokes, more than the " +
                  std::to_string(kMaxLines) + " that are read; draw outlines without hatching"));
  }
  std::vector<ArrangementLine> lines = SnapEnds(drawn, diagonal);
  Diagnostics log;
  auto arranged = Arrange(lines, diagonal).MoveInto(log);
  if (!arranged) return Outcome<PlanarMap>::Failure(std::move(log));
  auto closed = CloseGaps(std::move(*arranged), std::move(lines), options).MoveInto(log);
  if (!closed) return Outcome<PlanarMap>::Failure(std::move(log));
  auto merged = MergeCells(std::move(*closed)).MoveInto(log);
  if (!merged) return Outcome<PlanarMap>::Failure(std::move(log));
  return {std::move(*merged), std::move(log)};
}

}  // namespace lascaux

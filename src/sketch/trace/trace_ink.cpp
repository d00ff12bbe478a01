#include "sketch/trace/trace_ink.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sketch/trace/centre.h"
#include "sketch/trace/corners.h"
#include "sketch/trace/fit_curves.h"
#include "sketch/trace/ink_graph.h"
#include "sketch/trace/junctions.h"
#include "sketch/trace/thin.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;

constexpr double kTolerance = 0.06;      // widths that the curves may be off the middle of the ink
constexpr double kLeastTolerance = 0.3;  // pixels
constexpr double kDot = 0.6;             // widths that a line is long at least

Stroke Dot(const Vector2d& at, double width, const Ink& ink) {
  width = BlotWidthAt(ink.coverage, at, width / 2);
  Stroke dot;
  dot.pieces.push_back({{at, at, at, at}});
  dot.is_dot = true;
  dot.width = width;
  return dot;
}

Stroke StrokeOf(const Line& line, const Ink& ink, const TracePictureOptions& options) {
  Stroke stroke;
  stroke.width = line.width;
  stroke.closed = line.closed;
  const double tolerance = std::max(kLeastTolerance, kTolerance * line.width);
  const auto pieces = PiecesBetweenCorners(
      line, ink.coverage, {.degrees = options.corner, .width = std::max(line.width, 1.0)});
  for (const auto& piece : pieces) {
    const Ends ends = pieces.size() == 1 && line.closed ? Ends::kSmoothRing : Ends::kFree;
    const auto curves = FitCurves(piece, tolerance, ends);
    stroke.pieces.insert(stroke.pieces.end(), curves.begin(), curves.end());
  }
  for (std::size_t i = 1; i < stroke.pieces.size(); ++i)
    stroke.pieces[i].p[0] = stroke.pieces[i - 1].p[3];
  if (stroke.closed && !stroke.pieces.empty())
    stroke.pieces.back().p[3] = stroke.pieces.front().p[0];
  return stroke;
}

/// The point of a stroke nearest to another one's end, but on itself not near that end.
Vector2d Foot(const Stroke& bar, const Vector2d& end, const Stroke* own) {
  constexpr double kFlat = 0.01;  // pixels
  Vector2d best = end;
  double nearest = std::numeric_limits<double>::infinity();
  for (const CubicBezier& piece : bar.pieces) {
    if (own != nullptr && (piece.p[0] == end || piece.p[3] == end)) continue;
    const auto samples = Flatten(piece, kFlat);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Vector2d a = samples[i - 1].point, step = samples[i].point - a;
      const double length2 = step.squaredNorm();
      const double t = length2 > 0 ? std::clamp((end - a).dot(step) / length2, 0.0, 1.0) : 0;
      const double distance = (a + t * step - end).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      const double parameter = samples[i - 1].t + t * (samples[i].t - samples[i - 1].t);
      best = piece.At(parameter);
    }
  }
  return best;
}

/// Puts ends that are on another line exactly on its curve.
void SnapEnds(const std::vector<Line>& lines, std::vector<Stroke>& strokes) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (strokes[i].pieces.empty() || lines[i].closed) continue;
    for (int which = 0; which < 2; ++which) {
      const int on = lines[i].ends[which].on_line;
      if (on < 0) continue;
      const Stroke& bar = strokes[static_cast<std::size_t>(on)];
      CubicBezier& piece = which == 0 ? strokes[i].pieces.front() : strokes[i].pieces.back();
      const std::size_t end = which == 0 ? 0 : 3, handle = which == 0 ? 1 : 2;
      const Vector2d foot =
          Foot(bar, piece.p[end], static_cast<std::size_t>(on) == i ? &bar : nullptr);
      const Vector2d shift = foot - piece.p[end];
      if (shift.norm() > lines[i].width) continue;
      piece.p[end] = foot;
      piece.p[handle] += shift;
    }
  }
}

bool IsPoint(const Stroke& stroke) {
  return std::all_of(stroke.pieces.begin(), stroke.pieces.end(), [](const CubicBezier& piece) {
    return (piece.p[3] - piece.p[0]).norm() + (piece.p[1] - piece.p[0]).norm() < 1e-9;
  });
}

}  // namespace

std::vector<Stroke> TraceInk(const Ink& ink, const TracePictureOptions& options) {
  InkGraph graph = GraphOf(Thinned(ink.mask, ink.squared), ink.squared);
  RemoveSpurs(graph, options.spur);
  Centre(graph, ink);
  std::vector<Stroke> strokes;
  const std::vector<Line> lines = LinesOf(graph, ink.coverage, options);
  for (const Line& line : lines) strokes.push_back(StrokeOf(line, ink, options));
  SnapEnds(lines, strokes);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool meets = lines[i].ends[0].on_line >= 0 || lines[i].ends[1].on_line >= 0;
    const bool blot =
        !lines[i].closed && !meets && LengthOf(lines[i].points) < kDot * lines[i].width;
    if (blot)
      strokes[i] =
          Dot(0.5 * (lines[i].points.front() + lines[i].points.back()), lines[i].width, ink);
  }
  std::erase_if(strokes,
                [](const Stroke& s) { return s.pieces.empty() || (!s.is_dot && IsPoint(s)); });
  for (const InkNode& node : graph.nodes)
    if (node.ends.empty() && node.half_width > 0)
      strokes.push_back(Dot(node.at, 2 * node.half_width, ink));
  return strokes;
}

}  // namespace lascaux::trace

#include "sketch/svg/strokes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sketch/svg/page.h"

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

/// A piece is no longer than rounding when its points differ by less than this share of their
/// coordinates: a few thousand units in the last place, as sums of relative coordinates have.
constexpr double kRounding = 1e-12;

bool IsPoint(const CubicBezier& piece, double tolerance) {
  return std::all_of(piece.p.begin() + 1, piece.p.end(), [&](const Vector2d& point) {
    return (point - piece.p[0]).cwiseAbs().maxCoeff() <= tolerance;
  });
}

double LargestCoordinate(const std::vector<CubicBezier>& pieces) {
  double largest = 0;
  for (const CubicBezier& piece : pieces) {
    for (const Vector2d& point : piece.p) {
      if (!point.allFinite()) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, point.cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

std::vector<CubicBezier> Mapped(const std::vector<CubicBezier>& pieces,
                                const Eigen::Affine2d& map) {
  std::vector<CubicBezier> result = pieces;
  for (CubicBezier& piece : result) {
    for (Vector2d& point : piece.p) point = map * point;
  }
  return result;
}

/// The pieces that have a length, each beginning exactly where the one before ends.
std::vector<CubicBezier> Joined(const std::vector<CubicBezier>& pieces, double tolerance) {
  std::vector<CubicBezier> result;
  for (const CubicBezier& piece : pieces) {
    if (IsPoint(piece, tolerance)) continue;
    result.push_back(piece);
    if (result.size() > 1) result.back().p[0] = result[result.size() - 2].p[3];
  }
  return result;
}

}  // namespace

void StrokeCollector::Add(const Subpath& subpath, const Pen& pen) {
  PaintedSubpath candidate;
  candidate.is_line = pen.style.DrawsLine();
  candidate.is_area = pen.style.DrawsArea();
  if (!candidate.is_line && !candidate.is_area) return;
  candidate.covers = pen.style.Covers() && !pen.is_clipped;
  candidate.fill_rule = pen.style.fill_rule;
  candidate.order = pen.order;
  Stroke& stroke = candidate.stroke;
  stroke.svg_id = pen.svg_id;
  stroke.closed = subpath.closed;
  if (candidate.is_line) {
    const double scale = std::sqrt(std::abs(pen.to_sketch.linear().determinant()));
    stroke.width = pen.style.stroke_width * scale;
    stroke.stroke_color = pen.style.ColorOf(pen.style.stroke);
  }
  if (candidate.is_area) stroke.fill_color = pen.style.ColorOf(pen.style.fill);

  candidate.element = pen.element;
  candidate.start = pen.to_sketch * subpath.start;
  const std::vector<CubicBezier> pieces = Mapped(subpath.pieces, pen.to_sketch);
  const double largest = std::max(LargestCoordinate(pieces), candidate.start.cwiseAbs().maxCoeff());
  if (!(largest <= kMaxCoordinate) || !candidate.start.allFinite() ||
      !(stroke.width <= kMaxCoordinate)) {
    if (!not_finite_) not_finite_ = pen.element;
    return;
  }
  stroke.pieces = Joined(pieces, kRounding * largest);
  candidate.dropped_pieces = static_cast<int>(pieces.size() - stroke.pieces.size());
  if (stroke.pieces.empty()) {
    stroke.closed = false;
    stroke.is_dot = candidate.is_line && pen.style.cap == LineCap::kRound;
    const Vector2d& at = candidate.start;
    if (stroke.is_dot) {
      stroke.pieces.push_back({{at, at, at, at}});
      candidate.dropped_pieces = 0;
    }
  } else if (stroke.closed) {
    // The line back to the start may be nothing but rounding: then the piece before it ends there.
    if (subpath.has_closing_line && IsPoint(pieces.back(), kRounding * largest)) {
      --candidate.dropped_pieces;
    }
    stroke.pieces.back().p[3] = stroke.pieces.front().p[0];
  }
  painted_.push_back(std::move(candidate));
}

Outcome<Sketch> StrokeCollector::Finish(Reading& reading) && {
  if (not_finite_) return reading.Failed(OutOfRange(reading.Name(not_finite_)));
  return DrawPage(std::move(painted_), reading);
}

}  // namespace lascaux::svg

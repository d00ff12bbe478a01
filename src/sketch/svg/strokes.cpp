#include "sketch/svg/strokes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sketch/svg/duplicates.h"

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

/// A piece is no longer than rounding when its points differ by less than this share of their
/// coordinates: a few thousand units in the last place, as sums of relative coordinates have.
constexpr double kRounding = 1e-12;

/// Coordinates up to this can be squared and squared again without overflow; drawings above its
/// inverse without underflow.
constexpr double kMaxCoordinate = 1e75;

constexpr const char* kZeroLength = "zero-length-piece";
constexpr const char* kDuplicate = "duplicate-stroke";

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

/// An area's outline is closed, whether its path says so or not: that is how it is filled.
Stroke Closed(Stroke area) {
  const Vector2d begin = area.pieces.front().p[0], end = area.pieces.back().p[3];
  if (begin != end) area.pieces.push_back(Line(end, begin));
  area.closed = true;
  return area;
}

Diagnostic OutOfRange(const std::string& name) {
  return Error(FailureKind::kInput, "not-finite",
               fmt::format("{}: coordinates, matrices and pen widths must be numbers of at most "
                           "{:g}, and the whole drawing not smaller than {:g}; correct the number "
                           "or scale the drawing",
                           name, kMaxCoordinate, 1 / kMaxCoordinate));
}

Diagnostic NoStrokes(const std::string& root) {
  return Error(FailureKind::kInput, "no-strokes",
               fmt::format("nothing in {} draws a line: each element is hidden, empty, or has "
                           "neither a stroke nor a fill; draw the outline with a stroke, and "
                           "convert text and pictures to paths",
                           root));
}

Diagnostic ZeroLength(const std::string& name, int pieces) {
  return Note(kZeroLength, fmt::format("{}: {} of no length left out; remove repeated points", name,
                                       pieces > 1 ? fmt::format("{} pieces", pieces) : "a piece"));
}

Diagnostic Duplicate(const std::string& name, const std::string& first) {
  return Note(kDuplicate,
              fmt::format("{} runs along the same curve as {} and was left out", name, first));
}

}  // namespace

void StrokeCollector::Add(const Subpath& subpath, const Pen& pen) {
  Candidate candidate;
  candidate.is_line = pen.style.DrawsLine();
  candidate.is_area = pen.style.DrawsArea();
  if (!candidate.is_line && !candidate.is_area) return;
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
  candidates_.push_back(std::move(candidate));
}

Outcome<Sketch> StrokeCollector::Finish(Reading& reading) && {
  Findings& findings = reading.findings();
  if (not_finite_) return reading.Failed(OutOfRange(reading.Name(not_finite_)));
  // Lines first: an area that is the same curve as a line is that line's filling, whichever is
  // drawn first.
  std::vector<Candidate*> order;
  for (Candidate& c : candidates_) order.push_back(&c);
  std::stable_partition(order.begin(), order.end(), [](const Candidate* c) { return c->is_line; });
  const bool has_lines = std::any_of(order.begin(), order.end(), [](const Candidate* c) {
    return c->is_line && !c->stroke.pieces.empty();
  });
  std::vector<Candidate*> drawn;
  std::vector<const Stroke*> curves;
  for (Candidate* c : order) {
    if (!c->stroke.pieces.empty()) {
      drawn.push_back(c);
      curves.push_back(&c->stroke);
    } else if (c->is_line || !has_lines) {
      findings.Add(kZeroLength,
                   [&] { return ZeroLength(reading.Name(c->element), c->dropped_pieces); });
    }
  }
  if (drawn.empty()) return reading.Failed(NoStrokes(reading.RootName()));

  Sketch sketch;
  const std::vector<std::size_t> first = FirstOfEach(curves);
  std::vector<int> index(drawn.size(), -1);  // in the sketch
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    Candidate& c = *drawn[i];
    const int kept = index[first[i]];
    if (first[i] != i) {
      if (kept < 0) continue;
      Stroke& stroke = sketch.strokes[static_cast<std::size_t>(kept)];
      if (!stroke.fill_color) stroke.fill_color = c.stroke.fill_color;
      findings.Add(kDuplicate, [&] {
        const std::string name = reading.Name(c.element);
        const std::string before = reading.Name(drawn[first[i]]->element);
        return At(OnStroke(Duplicate(name, before), kept), c.start);
      });
    } else if (c.is_line || !has_lines) {
      index[i] = static_cast<int>(sketch.strokes.size());
      if (c.dropped_pieces > 0) {
        findings.Add(kZeroLength, [&] {
          const Diagnostic note = ZeroLength(reading.Name(c.element), c.dropped_pieces);
          return At(OnStroke(note, index[i]), c.start);
        });
      }
      sketch.strokes.push_back(has_lines ? std::move(c.stroke) : Closed(std::move(c.stroke)));
    }
  }
  const double diagonal = Bounds(sketch).diagonal().norm();
  if (diagonal > 0 && diagonal < 1 / kMaxCoordinate) {
    return reading.Failed(OutOfRange(reading.Name(drawn.front()->element)));
  }
  return {std::move(sketch), std::move(findings).Take()};
}

}  // namespace lascaux::svg

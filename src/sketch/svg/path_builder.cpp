#include "sketch/svg/path_builder.h"

namespace lascaux::svg {

using Eigen::Vector2d;

void PathBuilder::MoveTo(const Vector2d& point) {
  start_ = position_ = point;
  pen_ = Pen::kMoved;
}

void PathBuilder::LineTo(const Vector2d& point) { Append(Line(position_, point)); }

void PathBuilder::CubicTo(const Vector2d& handle_a, const Vector2d& handle_b,
                          const Vector2d& point) {
  Append({{position_, handle_a, handle_b, point}});
}

void PathBuilder::ArcTo(const EllipticArc& arc) {
  const std::vector<CubicBezier> pieces = ArcPieces(position_, arc);
  // An arc that goes nowhere is still drawn by its pen: a round one leaves a dot.
  if (pieces.empty()) return LineTo(arc.end);
  for (const CubicBezier& piece : pieces) Append(piece);
}

void PathBuilder::Close() {
  if (pen_ == Pen::kUp) return;
  const bool away = position_ != start_;
  if (away) LineTo(start_);
  Current().closed = true;
  Current().has_closing_line = away;
  position_ = start_;
  pen_ = Pen::kUp;
}

Subpath& PathBuilder::Current() {
  if (pen_ != Pen::kDrawing) {
    start_ = position_;
    subpaths_.push_back({start_, {}, false, false});
    pen_ = Pen::kDrawing;
  }
  return subpaths_.back();
}

void PathBuilder::Append(const CubicBezier& piece) {
  if (--pieces_left_ < 0) {
    pieces_left_ = -1;
    return;
  }
  Current().pieces.push_back(piece);
  position_ = piece.p[3];
}

}  // namespace lascaux::svg

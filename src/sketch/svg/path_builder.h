#pragma once

#include <Eigen/Core>
#include <vector>

#include "lascaux/sketch/bezier.h"

/// @file
/// Subpaths in the making: the pen's moves, as path data and the basic shapes make them.

namespace lascaux::svg {

/// What the pen draws without being lifted, in the element's own user units.
struct Subpath {
  Eigen::Vector2d start;            ///< where the pen was put down
  std::vector<CubicBezier> pieces;  ///< may be empty: a point ("M 1 1 z")
  bool closed = false;
  bool has_closing_line = false;  ///< the last piece is the straight line that closing made
};

/// An elliptic arc from the pen's position, as path data describes it.
struct EllipticArc {
  Eigen::Vector2d radii;
  double rotation_degrees = 0;  ///< of the first radius from the x axis
  bool large = false;
  bool sweep = false;  ///< by growing angles: clockwise as seen on the page
  Eigen::Vector2d end;
};

/// Cubic pieces of at most 45 degrees for the arc from `start`: within 5e-6 radii of the ellipse,
/// the first beginning and the last ending exactly where asked. A straight line where a radius is
/// 0, nothing where both ends are equal, as SVG 1.1 rules in its appendix F.6. Points that are not
/// finite come out as such.
std::vector<CubicBezier> ArcPieces(const Eigen::Vector2d& start, const EllipticArc& arc);

/// Collects pieces into subpaths; after `max_pieces` it takes no more and says so.
class PathBuilder {
 public:
  explicit PathBuilder(int max_pieces) : pieces_left_(max_pieces) {}

  void MoveTo(const Eigen::Vector2d& point);
  void LineTo(const Eigen::Vector2d& point);
  void CubicTo(const Eigen::Vector2d& handle_a, const Eigen::Vector2d& handle_b,
               const Eigen::Vector2d& point);
  void ArcTo(const EllipticArc& arc);
  /// Back to where the pen was put down, by a line unless it is there.
  void Close();

  const Eigen::Vector2d& position() const { return position_; }
  bool overflowed() const { return pieces_left_ < 0; }
  std::vector<Subpath> Take() && { return std::move(subpaths_); }

 private:
  enum class Pen { kUp, kMoved, kDrawing };

  Subpath& Current();
  void Append(const CubicBezier& piece);

  std::vector<Subpath> subpaths_;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero(), position_ = Eigen::Vector2d::Zero();
  Pen pen_ = Pen::kUp;
  int pieces_left_;
};

}  // namespace lascaux::svg

#include "sketch/depth/side_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sketch/map/polyline.h"
#include "sketch/parts/evidence.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Index = std::size_t;

/// A leg ends in the lowest part of the drawing, this share of its height, ...
constexpr double kGround = 0.35;
/// ... or, where its joint is no sure sign, stands on the ground, ...
constexpr double kStands = 0.08;
/// ... points down by at least this sine (35 degrees), ...
constexpr double kDown = 0.57;
/// ... and is at least so many times as long as its joint and as it is wide on average.
constexpr double kLongerThanJoint = 1.2, kSlender = 1.6;
/// An ear points up by at least this sine, ...
constexpr double kUp = 0.34;
/// ... is longer than its joint, ...
constexpr double kLeastReach = 0.9;
/// ... shares at most this part of its outline with the head, ...
constexpr double kMostShared = 0.45;
/// ... is at most this share of the animal's area, ...
constexpr double kMostEar = 0.06;
/// ... and lies within this share of the diagonal of an eye.
constexpr double kNearEye = 0.21;
/// Without eyes, how much farther the head's end must reach beyond the legs than the other one.
constexpr double kLongerEnd = 1.2;
/// Roots of a pair are at most this share of the diagonal apart, and their lengths differ by at
/// most this factor.
constexpr double kPairApart = 0.2, kPairRatio = 1.7;
/// The greatest angle between them.
constexpr double kPairSwing = std::numbers::pi / 3;

Vector2d Farthest(const Vector2d& from, const std::vector<Vector2d>& points) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector2d& a, const Vector2d& b) {
    return (a - from).squaredNorm() < (b - from).squaredNorm();
  });
}

}  // namespace

/// A cell seen from its joint.
struct SideCells::Shape {
  Vector2d joint = Vector2d::Zero();  ///< middle of what it shares with its parent
  Vector2d tip = Vector2d::Zero();    ///< from the joint to the farthest point
  Vector2d chord = Vector2d::Zero();  ///< across the joint
  double shared = 0;                  ///< share of the outline that is joint
  double area = 0;
  double lowest = 0;
};

SideCells::SideCells(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
                     const DepthGraph& graph)
    : map_(map), parts_(parts), adjacency_(adjacency) {
  top_ = left_ = std::numeric_limits<double>::infinity();
  bottom_ = right_ = -top_;
  for (Index i = 0; i < parts.parts.size(); ++i) {
    const Part& part = parts.parts[i];
    if (part.kind == PartKind::kIsland) eyes_.push_back(Centroid(part.outline.points));
    for (const Vector2d& p : part.outline.points) {
      top_ = std::min(top_, p.y());
      bottom_ = std::max(bottom_, p.y());
      if (static_cast<int>(i) != graph.body) continue;
      left_ = std::min(left_, p.x());
      right_ = std::max(right_, p.x());
    }
  }
  for (const Part& part : parts.parts) {
    if (!part.root) continue;
    const auto& points = part.outline.points;
    const bool stands = std::any_of(points.begin(), points.end(), [&](const Vector2d& p) {
      return p.y() > bottom_ - kGround * (bottom_ - top_);
    });
    if (stands) roots_.push_back(0.5 * (part.root->closed[0] + part.root->closed[1]));
  }
}

SideCells::Shape SideCells::ShapeOf(int cell, int parent, const std::vector<int>& more) const {
  const Part& part = parts_.parts[static_cast<Index>(cell)];
  Shape shape;
  Polyline joint;
  double length = 0, outline = 0;
  for (const std::vector<int>& stretch : part.stretches) {
    for (const int h : stretch) {
      const Polyline& line = map_.edges[static_cast<Index>(h / 2)].points;
      const double piece = Length(line);
      outline += piece;
      if (adjacency_.owner[static_cast<Index>(PlanarMap::Twin(h))] != parent) continue;
      shape.joint += piece * PointAtLength(line, 0.5 * piece);
      length += piece;
      joint.insert(joint.end(), line.begin(), line.end());
    }
  }
  if (length <= 0) return shape;
  shape.joint /= length;
  shape.shared = length / outline;
  shape.chord = Farthest(joint.front(), joint) - joint.front();
  std::vector<int> all = more;
  all.push_back(cell);
  shape.lowest = -std::numeric_limits<double>::infinity();
  for (const int i : all) {
    const auto& points = parts_.parts[static_cast<Index>(i)].outline.points;
    shape.area += SignedArea(points);
    const Vector2d tip = Farthest(shape.joint, points) - shape.joint;
    if (tip.squaredNorm() > shape.tip.squaredNorm()) shape.tip = tip;
    for (const Vector2d& p : points) shape.lowest = std::max(shape.lowest, p.y());
  }
  return shape;
}

double SideCells::LegScore(const Shape& shape, int parent) const {
  const double reach = shape.tip.norm(), height = bottom_ - top_;
  // The joint lies across a leg on the underside; that of a tail stands upright on the rump.
  const bool across = std::abs(shape.chord.x()) > std::abs(shape.chord.y());
  const auto& outline = parts_.parts[static_cast<Index>(parent)].outline.points;
  return Evidence()
      .AtMost(bottom_ - shape.lowest, (across ? kGround : kStands) * height)
      .AtLeast(reach, kLongerThanJoint * shape.chord.norm())
      .AtLeast(shape.tip.y(), kDown * reach)
      .AtLeast(reach * reach, kSlender * shape.area)
      .AtLeast(shape.joint.y() - top_, Centroid(outline).y() - top_)
      .Score();
}

double SideCells::HeadScore(const Vector2d& joint) const {
  if (!eyes_.empty()) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector2d& eye : eyes_) nearest = std::min(nearest, (eye - joint).norm());
    return Evidence().AtMost(nearest, kNearEye * map_.diagonal).Score();
  }
  if (roots_.size() < 2) return -1;
  const auto [first, last] =
      std::minmax_element(roots_.begin(), roots_.end(),
                          [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  const double left = first->x() - left_, right = right_ - last->x();
  const bool faces_left = left > right;
  return Evidence()
      .AtLeast(std::max(left, right), kLongerEnd * std::min(left, right))
      .AtMost(faces_left ? joint.x() - left_ : right_ - joint.x(), std::max(left, right))
      .Score();
}

/// A head drawn from many cells has none that is an ear: an ear touches the head and at most the
/// other ear.
bool SideCells::IsInATangle(int cell, int parent) const {
  const auto& beside = adjacency_.shared[static_cast<Index>(cell)];
  return std::any_of(beside.begin(), beside.end(), [&](const auto& other) {
    const bool is_cell = parts_.parts[static_cast<Index>(other.first)].kind == PartKind::kBorder;
    return is_cell && other.first != parent && !Unlikeness(cell, other.first, parent);
  });
}

double SideCells::EarScore(const Shape& shape, int cell, int parent) const {
  if (roots_.empty()) return -1;
  const Part& part = parts_.parts[static_cast<Index>(cell)];
  const double reach = shape.tip.norm();
  double animal = 0;
  for (const Part& other : parts_.parts) {
    if (other.kind == PartKind::kBorder) animal += SignedArea(other.outline.points);
  }
  const auto& outline = parts_.parts[static_cast<Index>(parent)].outline.points;
  const bool holds_eye = std::any_of(eyes_.begin(), eyes_.end(), [&](const Vector2d& eye) {
    return Contains(part.outline.points, eye);
  });
  if (holds_eye || IsInATangle(cell, parent)) return -1;
  return Evidence()
      .AtLeast(-shape.tip.y(), kUp * reach)
      .AtMost(shape.shared, kMostShared)
      .AtLeast(reach, kLeastReach * shape.chord.norm())
      .AtMost(shape.area, kMostEar * animal)
      .AtMost(shape.joint.y() - top_, Centroid(outline).y() - top_)
      .And(HeadScore(shape.joint))
      .Score();
}

double SideCells::OneOfAPair(int cell, int parent, const std::vector<int>& more) const {
  const Shape own = ShapeOf(cell, parent, {});
  if (own.tip.squaredNorm() == 0) return -1;
  return std::max(LegScore(ShapeOf(cell, parent, more), parent), EarScore(own, cell, parent));
}

std::optional<SideCells::Unlike> SideCells::Unlikeness(int one, int other, int parent) const {
  const Shape a = ShapeOf(one, parent, {}), b = ShapeOf(other, parent, {});
  const double apart = (a.joint - b.joint).norm() / map_.diagonal;
  const double ratio = std::abs(std::log(a.tip.norm() / b.tip.norm()));
  const double swing = AngleBetween(a.tip, b.tip);
  const double score = Evidence()
                           .AtMost(apart, kPairApart)
                           .AtMost(ratio, std::log(kPairRatio))
                           .AtMost(swing, kPairSwing)
                           .Score();
  if (score < 0) return std::nullopt;
  return Unlike{apart + ratio + swing, score};
}

double SideCells::Lowest(int cell) const {
  double lowest = -std::numeric_limits<double>::infinity();
  for (const Vector2d& p : parts_.parts[static_cast<Index>(cell)].outline.points)
    lowest = std::max(lowest, p.y());
  return lowest;
}

}  // namespace lascaux

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

/// @file
/// Ends of branches that are cut off near a junction, and the lines that go on from them.

namespace lascaux::trace {

/// Where a branch is cut off at one of its ends, and the direction in which it arrives there.
struct Stub {
  std::size_t cut = 0;  ///< points before this one, counted from the end, go
  Eigen::Vector2d at = Eigen::Vector2d::Zero(), toward = Eigen::Vector2d::Zero();
};

/// The points of a branch seen from one of its ends (0: as they are).
class FromEnd {
 public:
  FromEnd(const std::vector<Eigen::Vector2d>& points, int end) : points_(points), end_(end) {}
  std::size_t size() const { return points_.size(); }
  const Eigen::Vector2d& operator[](std::size_t i) const {
    return end_ == 0 ? points_[i] : points_[points_.size() - 1 - i];
  }

 private:
  const std::vector<Eigen::Vector2d>& points_;
  int end_;
};

/// The unsigned angle between two directions, radians, and their cross product.
double Angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b);
double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The direction in which the points arrive at the first of them, from a parabola through those
/// within `stretch` over their arc length; from a chord when they are few. Zero for a single place.
Eigen::Vector2d TangentToward(const FromEnd& points, std::size_t first, double stretch);

/// A smooth curve from one stub to another, about a pixel a step, both ends left out.
std::vector<Eigen::Vector2d> Bridge(const Stub& a, const Stub& b);

/// Points on a straight line, about a pixel a step, `a` left out.
std::vector<Eigen::Vector2d> Straight(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The point of a polyline nearest to another one.
Eigen::Vector2d NearestOn(const std::vector<Eigen::Vector2d>& line, const Eigen::Vector2d& point);

}  // namespace lascaux::trace

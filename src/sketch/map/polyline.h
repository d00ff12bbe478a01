#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

/// @file
/// Polylines with arc length: the few measurements that the structure stages share.

namespace lascaux {

using Polyline = std::vector<Eigen::Vector2d>;

/// Length of the polyline.
double Length(const Polyline& line);

/// The point at arc length `s` from the beginning, clamped to the ends; `line` is not empty.
Eigen::Vector2d PointAtLength(const Polyline& line, double s);

/// Unit direction of the chord from the beginning to the point at arc length `reach`: a tangent
/// that does not hang on the first tiny segment. Zero for a polyline without length.
Eigen::Vector2d DepartureDirection(const Polyline& line, double reach);

/// Unit direction in which the polyline arrives at its end, by the last `reach` of it.
Eigen::Vector2d ArrivalDirection(const Polyline& line, double reach);

/// The part between arc lengths `from` <= `to`, both ends included.
Polyline Section(const Polyline& line, double from, double to);

/// The same points in the other order.
Polyline Reversed(Polyline line);

/// `count` >= 2 points at even arc lengths, both ends included.
Polyline Resampled(const Polyline& line, int count);

/// Appends `more` to `line`, leaving out points equal to the one before.
void Append(Polyline& line, const Polyline& more);

/// Angle between two directions, 0 to pi; 0 if one of them is zero.
double AngleBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// z component of the cross product.
double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Nearest point of a segment as its parameter, 0 to 1.
double NearestParameter(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                        const Eigen::Vector2d& p);

/// Parameters (on a-b, on c-d) at which two segments cross or touch, both 0 to 1; none for parallel
/// ones.
std::optional<std::pair<double, double>> Intersection(const Eigen::Vector2d& a,
                                                      const Eigen::Vector2d& b,
                                                      const Eigen::Vector2d& c,
                                                      const Eigen::Vector2d& d);

}  // namespace lascaux

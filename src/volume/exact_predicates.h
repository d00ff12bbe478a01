#pragma once

#include <Eigen/Core>
#include <array>

/// @file
/// Exact yes-or-no questions on points with single-precision coordinates. Each takes up to a few
/// microseconds, so ask only where cheap arithmetic leaves a doubt.

namespace lascaux {

using Corners = std::array<Eigen::Vector3f, 3>;

/// Are the three on one line?
bool AreCollinear(const Corners& t);

/// Do two triangles, both with area, have a point in common?
bool TrianglesMeet(const Corners& a, const Corners& b);

/// Does the segment p q (p may equal q) have a point in common with the triangle, which has area?
bool SegmentMeetsTriangle(const Eigen::Vector3f& p, const Eigen::Vector3f& q, const Corners& t);

/// Do the triangles (p, q, a) and (p, q, b), both with area, share more than their edge p q?
bool OverlapAcrossEdge(const Eigen::Vector3f& p, const Eigen::Vector3f& q, const Eigen::Vector3f& a,
                       const Eigen::Vector3f& b);

}  // namespace lascaux

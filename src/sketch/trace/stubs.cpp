#include "sketch/trace/stubs.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lascaux/sketch/bezier.h"

namespace lascaux::trace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

double Angle(const Vector2d& a, const Vector2d& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2d TangentToward(const FromEnd& points, std::size_t first, double stretch) {
  constexpr std::size_t kEnoughForParabola = 6;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  double s = 0;
  std::size_t i = first, count = 0;
  for (; i < points.size() && s <= stretch; ++i, ++count) {
    const Eigen::Vector3d basis(1, s, s * s);
    normal += basis * basis.transpose();
    right += basis * points[i].transpose();
    if (i + 1 < points.size()) s += (points[i + 1] - points[i]).norm();
  }
  Vector2d along = points[std::min(i, points.size()) - 1] - points[first];
  if (count >= kEnoughForParabola) {
    const Eigen::Matrix<double, 3, 2> fit = normal.fullPivLu().solve(right);
    const Vector2d slope = fit.row(1);
    if (slope.allFinite() && slope.dot(along) > 0) along = slope;
  }
  return along.norm() > 1e-9 ? Vector2d(-along.normalized()) : Vector2d::Zero();
}

Points Bridge(const Stub& a, const Stub& b) {
  const double chord = (b.at - a.at).norm();
  const CubicBezier curve{{a.at, a.at + chord / 3 * a.toward, b.at + chord / 3 * b.toward, b.at}};
  const int steps = std::max(1, static_cast<int>(std::ceil(chord)));
  Points points;
  for (int i = 1; i < steps; ++i) points.push_back(curve.At(static_cast<double>(i) / steps));
  return points;
}

Points Straight(const Vector2d& a, const Vector2d& b) {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm())));
  Points points;
  for (int i = 1; i <= steps; ++i) points.push_back(a + (b - a) * (static_cast<double>(i) / steps));
  return points;
}

Vector2d NearestOn(const Points& line, const Vector2d& point) {
  Vector2d best = line.front();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2d step = line[i] - line[i - 1];
    const double length2 = step.squaredNorm();
    const double t =
        length2 > 0 ? std::clamp((point - line[i - 1]).dot(step) / length2, 0.0, 1.0) : 0;
    const Vector2d foot = line[i - 1] + t * step;
    if ((foot - point).squaredNorm() < (best - point).squaredNorm()) best = foot;
  }
  return best;
}

}  // namespace lascaux::trace

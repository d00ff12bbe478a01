#include "sketch/map/polyline.h"

#include <algorithm>
#include <cmath>

namespace lascaux {

using Eigen::Vector2d;

double Length(const Polyline& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

Vector2d PointAtLength(const Polyline& line, double s) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = (line[i] - line[i - 1]).norm();
    if (s <= step && step > 0)
      return line[i - 1] + std::max(0.0, s / step) * (line[i] - line[i - 1]);
    s -= step;
  }
  return line.back();
}

Vector2d DepartureDirection(const Polyline& line, double reach) {
  const Vector2d d = PointAtLength(line, reach) - line.front();
  return d.isZero(0) ? d : d.stableNormalized();
}

Vector2d ArrivalDirection(const Polyline& line, double reach) {
  return -DepartureDirection(Reversed(line), reach);
}

Polyline Section(const Polyline& line, double from, double to) {
  Polyline result{PointAtLength(line, from)};
  double s = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    s += (line[i] - line[i - 1]).norm();
    if (s > from && s < to) Append(result, {line[i]});
  }
  Append(result, {PointAtLength(line, to)});
  return result;
}

Polyline Reversed(Polyline line) {
  std::reverse(line.begin(), line.end());
  return line;
}

Polyline Resampled(const Polyline& line, int count) {
  const double step = Length(line) / (count - 1);
  Polyline result{line.front()};
  double s = 0, next = step;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double piece = (line[i] - line[i - 1]).norm();
    while (piece > 0 && next <= s + piece && static_cast<int>(result.size()) < count - 1) {
      result.push_back(line[i - 1] + (next - s) / piece * (line[i] - line[i - 1]));
      next += step;
    }
    s += piece;
  }
  while (static_cast<int>(result.size()) < count) result.push_back(line.back());
  return result;
}

void Append(Polyline& line, const Polyline& more) {
  for (const Vector2d& p : more) {
    if (line.empty() || line.back() != p) line.push_back(p);
  }
}

double AngleBetween(const Vector2d& a, const Vector2d& b) {
  return std::atan2(std::abs(Cross(a, b)), a.dot(b));
}

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double NearestParameter(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d d = b - a;
  const double n = d.squaredNorm();
  return n > 0 ? std::clamp((p - a).dot(d) / n, 0.0, 1.0) : 0.0;
}

std::optional<std::pair<double, double>> Intersection(const Vector2d& a, const Vector2d& b,
                                                      const Vector2d& c, const Vector2d& d) {
  const Vector2d r = b - a, s = d - c;
  const double denominator = Cross(r, s);
  // Parallel to within rounding: overlapping lines meet at their ends, which are handled as ends.
  if (std::abs(denominator) <= 1e-14 * r.norm() * s.norm()) return std::nullopt;
  const double t = Cross(c - a, s) / denominator, u = Cross(c - a, r) / denominator;
  if (t < 0 || t > 1 || u < 0 || u > 1) return std::nullopt;
  return std::pair{t, u};
}

}  // namespace lascaux

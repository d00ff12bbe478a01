#include "lascaux/sketch/parts.h"

namespace lascaux {

using Eigen::Vector2d;

double SignedArea(const std::vector<Vector2d>& ring) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vector2d a = ring[i] - ring[0], b = ring[i + 1] - ring[0];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * sum;
}

bool Contains(const std::vector<Vector2d>& ring, const Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vector2d &a = ring[i], &b = ring[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

}  // namespace lascaux

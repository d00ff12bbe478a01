#include "volume/measure/nearest_piece.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lascaux {

using Eigen::Vector2d;

double OutlinePiece::DistanceTo(const Vector2d& p) const {
  const Vector2d to = p - middle;
  const double along = std::clamp(to.dot(tangent), -half_length, half_length);
  return (to - along * tangent).norm();
}

NearestPiece::NearestPiece(std::vector<OutlinePiece> pieces)
    : pieces_(std::move(pieces)), axis_(pieces_.size(), 0) {
  for (const OutlinePiece& piece : pieces_) {
    longest_half_ = std::max(longest_half_, piece.half_length);
  }
  Split(0, pieces_.size());
}

void NearestPiece::Split(std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  Eigen::AlignedBox2d box;
  for (std::size_t i = begin; i < end; ++i) box.extend(pieces_[i].middle);
  const int axis = box.sizes().x() >= box.sizes().y() ? 0 : 1;
  const std::size_t median = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) {
    return pieces_.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::nth_element(at(begin), at(median), at(end),
                   [axis](const OutlinePiece& a, const OutlinePiece& b) {
                     return a.middle[axis] < b.middle[axis];
                   });
  axis_[median] = static_cast<std::uint8_t>(axis);
  Split(begin, median);
  Split(median + 1, end);
}

void NearestPiece::Search(std::size_t begin, std::size_t end, const Vector2d& p,
                          double& best) const {
  if (begin == end) return;
  const std::size_t median = begin + (end - begin) / 2;
  best = std::min(best, pieces_[median].DistanceTo(p));
  const double beyond = p[axis_[median]] - pieces_[median].middle[axis_[median]];
  const bool above = beyond > 0;
  above ? Search(median + 1, end, p, best) : Search(begin, median, p, best);
  if (std::abs(beyond) > best + longest_half_) return;
  above ? Search(begin, median, p, best) : Search(median + 1, end, p, best);
}

double NearestPiece::Distance(const Vector2d& p) const {
  double best = std::numeric_limits<double>::infinity();
  Search(0, pieces_.size(), p, best);
  return best;
}

}  // namespace lascaux

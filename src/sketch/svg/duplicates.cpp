#include "sketch/svg/duplicates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

constexpr double kSameCurve = 1e-7;

/// Coordinates are rounded to a grid that no drawing is likely to have its own coordinates in the
/// middle of.
constexpr double kGridOffset = 0.381966;

class Grid {
 public:
  explicit Grid(const std::vector<const Stroke*>& strokes) {
    Eigen::AlignedBox2d box;
    for (const Stroke* stroke : strokes) {
      for (const CubicBezier& piece : stroke->pieces) box.extend(Bounds(piece));
    }
    if (box.isEmpty()) return;
    origin_ = box.min();
    if (box.diagonal().norm() > 0) cell_ = kSameCurve * box.diagonal().norm();
  }

  Vector2d Cell(const Vector2d& point) const {
    return ((point - origin_) / cell_).array().unaryExpr([](double x) {
      return std::floor(x + kGridOffset);
    });
  }

 private:
  Vector2d origin_ = Vector2d::Zero();
  double cell_ = 1;
};

std::uint64_t Mixed(std::uint64_t hash, double value) {
  hash ^= std::bit_cast<std::uint64_t>(value + 0.0);  // + 0.0 makes the zeros one
  hash *= 0x9E3779B97F4A7C15u;
  return hash ^ (hash >> 29);
}

/// The stroke's cells, from whichever end gives the lesser list, so that both directions are one.
std::vector<Vector2d> Signature(const Stroke& stroke, const Grid& grid) {
  std::vector<Vector2d> cells;
  cells.reserve(stroke.pieces.size() * 3 + 1);
  cells.push_back(grid.Cell(stroke.pieces.front().p[0]));
  for (const CubicBezier& piece : stroke.pieces) {
    for (std::size_t i = 1; i < 4; ++i) cells.push_back(grid.Cell(piece.p[i]));
  }
  const auto less = [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  if (std::lexicographical_compare(cells.rbegin(), cells.rend(), cells.begin(), cells.end(),
                                   less)) {
    std::reverse(cells.begin(), cells.end());
  }
  return cells;
}

}  // namespace

std::vector<std::size_t> FirstOfEach(const std::vector<const Stroke*>& strokes) {
  const Grid grid(strokes);
  std::map<std::uint64_t, std::size_t> known;
  std::vector<std::size_t> first(strokes.size());
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const std::vector<Vector2d> signature = Signature(*strokes[i], grid);
    std::uint64_t hash = signature.size();
    for (const Vector2d& cell : signature) hash = Mixed(Mixed(hash, cell.x()), cell.y());
    const auto [entry, is_new] = known.try_emplace(hash, i);
    // Of two different curves with one hash, the later is taken for unique.
    const bool same = !is_new && Signature(*strokes[entry->second], grid) == signature;
    first[i] = same ? entry->second : i;
  }
  return first;
}

}  // namespace lascaux::svg

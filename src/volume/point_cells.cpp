#include "volume/point_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

// Of a surface in a cell: two of the vector code's tiles, the last of which is rarely full.
constexpr double kPointsACell = 100;
// A surface meets about so many of k^3 cells, in k^2.
constexpr double kCellsMet = 2;
constexpr int kMostCells = 128;  // along the longest side

int CellsFor(std::size_t points) {
  const double cells = std::sqrt(static_cast<double>(points) / (kCellsMet * kPointsACell));
  return std::clamp(static_cast<int>(cells), 1, kMostCells);
}

Eigen::AlignedBox3f BoxOf(std::span<const Eigen::Vector3f> points) {
  using Range = tbb::blocked_range<std::size_t>;
  constexpr std::size_t kGrain = 8192;
  return tbb::parallel_reduce(
      Range(0, points.size(), kGrain), Eigen::AlignedBox3f(),
      [&](const Range& range, Eigen::AlignedBox3f box) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) box.extend(points[i]);
        return box;
      },
      [](const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) { return a.merged(b); });
}

}  // namespace

PointCells::PointCells(std::span<const Eigen::Vector3f> points) {
  const Eigen::AlignedBox3f box = BoxOf(points);
  const int cells = CellsFor(points.size());
  const float longest = box.isEmpty() ? 0.0F : box.sizes().maxCoeff();
  const float per_unit = longest > 0 ? static_cast<float>(cells) / longest : 0.0F;
  std::vector<std::uint32_t> key(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const Eigen::Array3i cell =
        ((points[i] - box.min()).array() * per_unit).cast<int>().min(cells - 1).max(0);
    key[i] = static_cast<std::uint32_t>((cell.x() * cells + cell.y()) * cells + cell.z());
  });
  // A counting sort.
  std::vector<std::uint32_t> next(static_cast<std::size_t>(cells * cells * cells) + 1, 0);
  for (const std::uint32_t k : key) ++next[k + 1];
  for (std::size_t k = 1; k < next.size(); ++k) {
    if (next[k] > 0) first_.push_back(next[k - 1]);
    next[k] += next[k - 1];
  }
  first_.push_back(points.size());
  order_.resize(points.size());
  for (std::uint32_t i = 0; i < key.size(); ++i) order_[next[key[i]]++] = i;
}

CellBlock::CellBlock(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> which,
                     const Eigen::Vector3d& offset) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t i : which) box.extend(points[i]);
  const Eigen::Vector3d center = box.cast<double>().center();
  ball = {center + offset, box.cast<double>().diagonal().norm() / 2};
  for (std::vector<float>& column : offsets) column.resize(which.size());
  for (std::size_t k = 0; k < which.size(); ++k) {
    const Eigen::Vector3f local = (points[which[k]].cast<double>() - center).cast<float>();
    for (int axis = 0; axis < 3; ++axis) offsets[static_cast<std::size_t>(axis)][k] = local[axis];
  }
}

}  // namespace lascaux

#include "volume/point_cells.h"

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

}  // namespace

PointCells::PointCells(std::span<const Eigen::Vector3f> points) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : points) box.extend(p);
  const int cells = CellsFor(points.size());
  const float longest = box.isEmpty() ? 0.0F : box.sizes().maxCoeff();
  const float per_unit = longest > 0 ? static_cast<float>(cells) / longest : 0.0F;
  std::vector<std::uint32_t> key(points.size());
  // A counting sort.
  std::vector<std::uint32_t> next(static_cast<std::size_t>(cells * cells * cells) + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array3i cell =
        ((points[i] - box.min()).array() * per_unit).cast<int>().min(cells - 1).max(0);
    key[i] = static_cast<std::uint32_t>((cell.x() * cells + cell.y()) * cells + cell.z());
    ++next[key[i] + 1];
  }
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
  Eigen::AlignedBox3d box;
  for (const std::uint32_t i : which) box.extend(points[i].cast<double>());
  ball = {box.center() + offset, box.diagonal().norm() / 2};
  for (std::vector<float>& column : offsets) column.reserve(which.size());
  for (const std::uint32_t i : which) {
    const Eigen::Vector3f local = (points[i].cast<double>() - box.center()).cast<float>();
    for (int k = 0; k < 3; ++k) offsets[static_cast<std::size_t>(k)].push_back(local[k]);
  }
}

}  // namespace lascaux

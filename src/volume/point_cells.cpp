#include "volume/point_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace lascaux {
namespace {

constexpr int kCells = 48;  // along the longest side: a few dozen points of a surface in each

}  // namespace

PointCells::PointCells(std::span<const Eigen::Vector3f> points) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : points) box.extend(p);
  const float longest = box.isEmpty() ? 0.0F : box.sizes().maxCoeff();
  const float per_unit = longest > 0 ? static_cast<float>(kCells) / longest : 0.0F;
  const auto key = [&](const Eigen::Vector3f& p) {
    const Eigen::Array3i cell =
        ((p - box.min()).array() * per_unit).cast<int>().min(kCells - 1).max(0);
    return static_cast<std::uint32_t>((cell.x() * kCells + cell.y()) * kCells + cell.z());
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed(points.size());
  for (std::uint32_t i = 0; i < keyed.size(); ++i) keyed[i] = {key(points[i]), i};
  std::sort(keyed.begin(), keyed.end());
  order_.reserve(keyed.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].first != keyed[i - 1].first) first_.push_back(i);
    order_.push_back(keyed[i].second);
  }
  first_.push_back(keyed.size());
}

CellBlock::CellBlock(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> which,
                     const Eigen::Vector3d& offset) {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t i : which) box.extend(points[i].cast<double>());
  ball = {box.center() + offset, box.diagonal().norm() / 2};
  for (const std::uint32_t i : which) {
    const Eigen::Vector3f local = (points[i].cast<double>() - box.center()).cast<float>();
    for (int k = 0; k < 3; ++k) offsets[static_cast<std::size_t>(k)].push_back(local[k]);
  }
}

}  // namespace lascaux

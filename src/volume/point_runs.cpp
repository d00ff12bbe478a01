#include "volume/point_runs.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

constexpr std::size_t kGrain = 8192;     // points a task
constexpr std::size_t kMostInRun = 128;  // two of the vector code's tiles
constexpr double kPointsARun = 100;
// A surface meets about so many of k^3 cells, in k^2.
constexpr double kCellsMet = 2;

Eigen::AlignedBox3f BoxOf(std::span<const Eigen::Vector3f> points) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, points.size(), kGrain), Eigen::AlignedBox3f(),
      [&](const Range& range, Eigen::AlignedBox3f box) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) box.extend(points[i]);
        return box;
      },
      [](const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) { return a.merged(b); });
}

/// How long a run may be along each axis: as the cells that a surface of so many points would have
/// kPointsARun in each.
float LongestRun(std::span<const Eigen::Vector3f> points) {
  const Eigen::AlignedBox3f box = BoxOf(points);
  const double cells = std::sqrt(static_cast<double>(points.size()) / (kCellsMet * kPointsARun));
  return box.isEmpty() ? 0.0F : box.sizes().maxCoeff() / static_cast<float>(std::max(cells, 1.0));
}

}  // namespace

PointRuns::PointRuns(std::span<const Eigen::Vector3f> points) {
  const float longest = LongestRun(points);
  const std::size_t tasks = (points.size() + kGrain - 1) / kGrain;
  std::vector<std::vector<std::uint32_t>> firsts(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t end = std::min(points.size(), (task + 1) * kGrain);
    Eigen::AlignedBox3f box;
    std::size_t first = 0;
    for (std::size_t i = task * kGrain; i < end; ++i) {
      const Eigen::AlignedBox3f larger = box.extend(points[i]);
      if (i % kGrain == 0 || i - first == kMostInRun || larger.sizes().maxCoeff() > longest) {
        firsts[task].push_back(static_cast<std::uint32_t>(i));
        first = i;
        box = Eigen::AlignedBox3f(points[i]);
      }
    }
  });
  for (const std::vector<std::uint32_t>& some : firsts)
    first_.insert(first_.end(), some.begin(), some.end());
  first_.push_back(static_cast<std::uint32_t>(points.size()));
}

RunBlock::RunBlock(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& offset) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : points) box.extend(point);
  const Eigen::Vector3d center = box.cast<double>().center();
  ball = {center + offset, box.cast<double>().diagonal().norm() / 2};
  for (std::vector<float>& column : offsets) column.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f local = (points[i].cast<double>() - center).cast<float>();
    for (int axis = 0; axis < 3; ++axis) offsets[static_cast<std::size_t>(axis)][i] = local[axis];
  }
}

}  // namespace lascaux

#include "volume/thin_shapes.h"

#include <algorithm>
#include <cmath>

namespace lascaux::testing {
namespace {

using Eigen::Vector3d;

double Ball(const Vector3d& p, const Vector3d& center, double radius) {
  return (p - center).norm() - radius;
}

/// Around a segment from a to b.
double Capsule(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - radius;
}

}  // namespace

openvdb::FloatGrid::Ptr LevelSetOf(const Distance& distance, const Eigen::AlignedBox3d& box,
                                   double voxel_size) {
  const double band = 3 * voxel_size;
  auto grid = openvdb::FloatGrid::create(static_cast<float>(band));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel_size));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto values = grid->getAccessor();
  const auto voxel = [&](const Vector3d& p) {
    return openvdb::Coord::round(grid->worldToIndex(openvdb::Vec3d(p.x(), p.y(), p.z())));
  };
  const Vector3d margin = Vector3d::Constant(2 * band);
  const openvdb::CoordBBox voxels(voxel(box.min() - margin), voxel(box.max() + margin));
  for (auto ijk = voxels.begin(); ijk; ++ijk) {
    const openvdb::Vec3d p = grid->indexToWorld(*ijk);
    const double d = distance(Vector3d(p.x(), p.y(), p.z()));
    if (std::abs(d) < band) {
      values.setValue(*ijk, static_cast<float>(d));
    } else if (d < 0) {
      values.setValueOff(*ijk, static_cast<float>(-band));
    }
  }
  return grid;
}

openvdb::FloatGrid::Ptr Neck() {
  const Vector3d a(-14, 0, 0), b(14, 0, 0);
  return LevelSetOf(
      [&](const Vector3d& p) {
        return std::min({Ball(p, a, 8), Ball(p, b, 8), Capsule(p, a, b, kThin / 2)});
      },
      {Vector3d(-22, -8, -8), Vector3d(22, 8, 8)}, kVoxel);
}

openvdb::FloatGrid::Ptr Leg() {
  const Vector3d hip(0, 0, 0), foot(0, kThin / 2 - 16, 0);
  return LevelSetOf(
      [&](const Vector3d& p) {
        return std::min(Ball(p, hip, 8), Capsule(p, hip, foot, kThin / 2));
      },
      {Vector3d(-8, -16, -8), Vector3d(8, 8, 8)}, kVoxel);
}

openvdb::FloatGrid::Ptr Membrane() {
  return LevelSetOf(
      [](const Vector3d& p) {
        const double off = p.head<2>().norm() - 10;
        const double ring = std::hypot(off, p.z()) - 2;
        return std::min(ring, std::max(std::abs(p.z()) - kThin / 2, off));
      },
      {Vector3d(-12, -12, -2), Vector3d(12, 12, 2)}, kVoxel);
}

openvdb::FloatGrid::Ptr Spike() {
  const double half_angle = std::atan(3 / 12.5);
  return LevelSetOf(
      [&](const Vector3d& p) {
        const double around = p.tail<2>().norm();
        const double cone = around * std::cos(half_angle) - (12 - p.x()) * std::sin(half_angle);
        return std::min(Ball(p, Vector3d::Zero(), 3), std::max(cone, -p.x()));
      },
      {Vector3d(-3, -3, -3), Vector3d(12, 3, 3)}, kVoxel);
}

}  // namespace lascaux::testing

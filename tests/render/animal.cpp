#include "render/animal.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace lascaux {
namespace {

struct Cone {
  Eigen::Vector3f a, b;
  float radius_a, radius_b;
};

/// In millimetres; legs are drawn on one side and mirrored.
std::vector<Cone> Body() {
  std::vector<Cone> body = {{{22, 47, 0}, {70, 46, 0}, 13, 12},     // trunk
                            {{70, 50, 0}, {84, 68, 0}, 9, 6.5F},    // neck
                            {{84, 70, 0}, {95, 65, 0}, 7.5F, 4.F},  // head
                            {{10, 51, 0}, {2, 34, 0}, 3.F, 1.5F}};  // tail
  const std::vector<Cone> near_side = {
      {{22, 42, 7}, {20, 25, 8}, 8, 4},    {{20, 25, 8}, {22, 3, 8}, 4, 3},
      {{69, 42, 6}, {70, 24, 7}, 7, 3.8F}, {{70, 24, 7}, {69, 3, 7}, 3.8F, 3},
      {{81, 75, 4}, {79, 82, 6}, 2.2F, 1}, {{90, 71, 5}, {90.5F, 71.2F, 5.4F}, 1.6F, 1.6F}};
  for (const Cone& cone : near_side) {
    const Eigen::Vector3f mirror(1, 1, -1);
    body.push_back(cone);
    body.push_back(
        {cone.a.cwiseProduct(mirror), cone.b.cwiseProduct(mirror), cone.radius_a, cone.radius_b});
  }
  return body;
}

float Distance(const Cone& cone, const Eigen::Vector3f& p) {
  const Eigen::Vector3f axis = cone.b - cone.a;
  const float t = std::clamp((p - cone.a).dot(axis) / axis.squaredNorm(), 0.F, 1.F);
  return (p - cone.a - t * axis).norm() - (cone.radius_a + t * (cone.radius_b - cone.radius_a));
}

/// Smooth union: a fillet of a few millimetres.
float Distance(const std::vector<Cone>& body, const Eigen::Vector3f& p) {
  constexpr float kFillet = 2;
  float sum = 0;
  for (const Cone& cone : body) sum += std::exp(-std::max(Distance(cone, p), -60.F) / kFillet);
  return -kFillet * std::log(std::max(sum, 1e-30F));
}

openvdb::FloatGrid::Ptr Fill(int voxels, float direction) {
  openvdb::initialize();
  const double voxel = 100.0 / voxels;
  const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(voxel);
  const std::vector<Cone> body = Body();
  const auto steps = [&](double length) { return static_cast<int>(std::ceil(length / voxel)); };
  auto accessor = grid->getAccessor();
  for (int x = steps(-8); x < steps(108); ++x) {
    for (int y = steps(-8); y < steps(92); ++y) {
      for (int z = steps(-24); z <= steps(24); ++z) {
        const openvdb::Coord c(x, y, z);
        const auto place = grid->indexToWorld(c);
        const Eigen::Vector3f p(static_cast<float>(place.x()), static_cast<float>(place.y()),
                                static_cast<float>(place.z()));
        const float distance = Distance(body, {direction > 0 ? p.x() : 100 - p.x(), p.y(), p.z()});
        if (std::abs(distance) < grid->background()) accessor.setValue(c, distance);
      }
    }
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

}  // namespace

openvdb::FloatGrid::Ptr Animal(int voxels) { return Fill(voxels, 1); }
openvdb::FloatGrid::Ptr AnimalTurned(int voxels) { return Fill(voxels, -1); }

}  // namespace lascaux

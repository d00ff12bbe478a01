#include "volume/print/plate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lascaux/volume/stability.h"
#include "volume/check/hull.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounded = 0.3;      // radius of the plate's edges, of its thickness
constexpr double kThickness = 0.025;  // of the model's longest side: 2.5 mm for 10 cm
constexpr double kSink = 0.4;         // of the thickness: how deep the feet are in the plate
constexpr double kMargin = 0.04;      // of the longest side: how far the plate reaches beyond
constexpr double kSteady = 0.15;    // of the height of the centre of mass: it tips beyond 8 degrees
constexpr double kUnsteady = 0.05;  // of that height: what tips before 3 degrees does not stand
constexpr double kContact = 0.003;  // of the longest side: the feet's first layer
constexpr double kFewestVoxels = 4;  // of the plate's thickness, so that it has an inside

}  // namespace

double Plate::Distance(const Vector3d& p) const {
  const double thickness = top - bottom, radius = kRounded * thickness;
  const Vector2d q(-SignedDistanceInside({p.x(), p.z()}, hull) - (margin - radius),
                   std::abs(p.y() - (top + bottom) / 2) - (thickness / 2 - radius));
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
}

std::vector<Vector2d> Plate::SideView() const {
  constexpr int kOnArc = 8;  // segments of a rounded corner
  const double radius = kRounded * (top - bottom);
  double low = hull.front().x(), high = low;
  for (const Vector2d& p : hull) low = std::min(low, p.x()), high = std::max(high, p.x());
  low -= margin - radius;
  high += margin - radius;
  std::vector<Vector2d> ring;
  for (int corner = 0; corner < 4; ++corner) {
    const Vector2d center(corner == 0 || corner == 3 ? high : low,
                          corner < 2 ? top - radius : bottom + radius);
    for (int i = 0; i <= kOnArc; ++i) {
      const double angle = M_PI / 2 * (corner + static_cast<double>(i) / kOnArc);
      ring.push_back(center + radius * Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  return ring;
}

std::optional<Plate> PlateUnder(const Mesh& mesh, double voxel_size) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& v : mesh.vertices) box.extend(v.cast<double>());
  const double longest = box.sizes().maxCoeff();
  const auto stability = MeasureStability(mesh, kContact * longest);
  if (!stability) return std::nullopt;
  const double height = stability->center_of_mass.y() - box.min().y();
  if (stability->margin >= kUnsteady * height) return std::nullopt;
  const double thickness = std::max(kThickness * longest, kFewestVoxels * voxel_size);
  Plate plate;
  plate.top = box.min().y() + kSink * thickness;
  plate.bottom = plate.top - thickness;
  plate.margin = std::max(kMargin * longest, kSteady * height);
  std::vector<Vector2d> feet = {{stability->center_of_mass.x(), stability->center_of_mass.z()}};
  for (const Eigen::Vector3f& v : mesh.vertices)
    if (static_cast<double>(v.y()) <= plate.top)
      feet.emplace_back(static_cast<double>(v.x()), static_cast<double>(v.z()));
  plate.hull = ConvexHull(std::move(feet));
  return plate;
}

}  // namespace lascaux

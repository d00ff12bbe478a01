#include "skeleton/field_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "skeleton/chains.h"
#include "skeleton/index.h"
#include "skeleton/smoothstep.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Coefficients of a depth map along its longer side: a few for each radius of a slender part.
constexpr double kCells = 40;
/// Coefficients beyond the part's support on each side: the splines there have their own
/// neighbours, and not the border's repeated, which would bend tips.
constexpr int kMargin = 2;

/// The box that the part's field lives in.
Eigen::AlignedBox2d SupportBox(const std::vector<Chain>& chains) {
  Eigen::AlignedBox2d box;
  for (const Chain& chain : chains) {
    for (const SkeletonVertex& v : chain.vertices) {
      const Vector2d reach = Vector2d::Constant(kSupportRadii * v.radius);
      box.extend(Vector2d(v.position - reach));
      box.extend(Vector2d(v.position + reach));
    }
  }
  return box;
}

/// A station with what does not depend on the place that asks.
struct Pull {
  const DepthStation& station;
  double by_distance, log_scale, log_fuller;

  explicit Pull(const DepthStation& s)
      : station(s),
        by_distance(1 / (s.reach * s.reach)),
        log_scale(std::log(s.scale)),
        log_fuller(std::log(s.fuller)) {}
};

/// Average of the stations at a place: z, and log scale.
Vector2d Average(const std::vector<Pull>& pulls, const Vector2d& place) {
  Vector2d sum = Vector2d::Zero();
  double weights = 0;
  for (const Pull& pull : pulls) {
    const DepthStation& station = pull.station;
    const Vector2d way = place - station.position;
    const double rest = 1 + way.squaredNorm() * pull.by_distance;
    const double weight = 1 / (rest * rest * rest);
    const double fuller = pull.log_fuller * Smoothstep(station.belly.dot(way));
    sum += weight * Vector2d(station.z + station.tilt.dot(way), pull.log_scale + fuller);
    weights += weight;
  }
  return sum / weights;
}

DepthMap MapOf(const CreaturePart& part, const ModelFrame& frame) {
  Eigen::AlignedBox2d box = SupportBox(part.chains);
  const double cell = box.sizes().maxCoeff() / kCells;
  box.min().array() -= kMargin * cell;
  box.max().array() += kMargin * cell;
  DepthMap map;
  map.cell = frame.scale * cell;
  // Rows run upwards in the model, whose y is up.
  map.origin = frame.ToModel({box.min().x(), box.max().y()});
  map.columns = static_cast<int>(std::ceil(box.sizes().x() / cell)) + 1;
  map.rows = static_cast<int>(std::ceil(box.sizes().y() / cell)) + 1;
  map.middle.reserve(Index(map.columns) * Index(map.rows));
  map.steepness.reserve(map.middle.capacity());
  const std::vector<Pull> pulls(part.stations.begin(), part.stations.end());
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const Vector2d place(box.min().x() + cell * column, box.max().y() - cell * row);
      const Vector2d here = Average(pulls, place);
      map.middle.push_back(static_cast<float>(frame.scale * here.x()));
      map.steepness.push_back(static_cast<float>(std::exp(-here.y())));
    }
  }
  return map;
}

}  // namespace

FieldPart MakeFieldPart(const CreaturePart& part, const ModelFrame& frame) {
  FieldPart field;
  field.z0 = frame.scale * part.z;
  field.depth_scale = part.depth_scale;
  for (const Chain& chain : part.chains) {
    field.chains.push_back(MakeFieldChain(chain, frame, field.z0));
  }
  if (!part.stations.empty()) field.depth = MapOf(part, frame);
  return field;
}

FieldPart MirrorImage(const FieldPart& part) {
  FieldPart image = part;
  image.parent.reset();
  image.z0 = -part.z0;
  for (FieldChain& chain : image.chains) {
    for (Segment& s : chain.segments) s.a.z() *= -1, s.b.z() *= -1;
    for (PointPrimitive& p : chain.points) p.center.z() *= -1;
  }
  if (image.depth) {
    for (float& z : image.depth->middle) z = -z;
  }
  return image;
}

}  // namespace lascaux

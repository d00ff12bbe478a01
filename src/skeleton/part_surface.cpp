#include "skeleton/part_surface.h"

#include <algorithm>

#include "skeleton/field_part.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Halvings of an interval of a few radii: the surface is found to 1e-9 of one.
constexpr int kHalvings = 32;

/// y up, and no scale: depths are in sketch units.
Vector3d Up(const Vector2d& point, double z) { return {point.x(), -point.y(), z}; }

}  // namespace

PartSurface::PartSurface(const CreaturePart& part) {
  field_.parts.push_back(MakeFieldPart(part, {}));
  reach_ = Bounds(field_).sizes().z();
}

FieldSample PartSurface::At(const Vector2d& point, double z) const {
  return Evaluate(field_, Up(point, z));
}

double PartSurface::Distance(const Vector2d& point, double z) const {
  return SignedDistance(At(point, z));
}

std::optional<double> PartSurface::Front(const Vector2d& point) const {
  // The field falls with the distance from the part's middle.
  const double middle = Middle(point);
  if (At(point, middle).value < kIsoValue) return std::nullopt;
  double inside = middle, outside = middle + reach_;
  for (int i = 0; i < kHalvings; ++i) {
    const double half = (inside + outside) / 2;
    (At(point, half).value >= kIsoValue ? inside : outside) = half;
  }
  return inside;
}

Vector3d PartSurface::Normal(const Vector2d& point, double z) const {
  const Vector3d gradient = At(point, z).gradient;
  const double length = gradient.norm();
  if (!(length > 0)) return Vector3d::UnitZ();
  return Vector3d(-gradient.x(), gradient.y(), -gradient.z()) / length;
}

double PartSurface::Middle(const Vector2d& point) const {
  const FieldPart& part = field_.parts[0];
  return part.depth ? EvaluateDepth(*part.depth, {point.x(), -point.y()}).middle : part.z0;
}

double PartSurface::Scale(const Vector2d& point) const {
  const FieldPart& part = field_.parts[0];
  return part.depth ? 1 / EvaluateDepth(*part.depth, {point.x(), -point.y()}).steepness
                    : part.depth_scale;
}

}  // namespace lascaux

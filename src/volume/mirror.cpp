#include "volume/mirror.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lascaux {
namespace {

using Eigen::Vector3d;

bool AreMirrored(const Vector3d& p, const Vector3d& q) {
  return p.x() == q.x() && p.y() == q.y() && p.z() == -q.z();
}

bool AreMirrored(const Segment& p, const Segment& q) {
  return AreMirrored(p.a, q.a) && AreMirrored(p.b, q.b) && p.radius_a == q.radius_a &&
         p.radius_b == q.radius_b;
}

bool AreMirrored(const PointPrimitive& p, const PointPrimitive& q) {
  return AreMirrored(p.center, q.center) && p.radius == q.radius && p.weight == q.weight;
}

template <typename T>
bool AllMirrored(const std::vector<T>& p, const std::vector<T>& q) {
  return std::equal(p.begin(), p.end(), q.begin(), q.end(),
                    [](const T& a, const T& b) { return AreMirrored(a, b); });
}

bool AreMirrored(const FieldChain& p, const FieldChain& q) {
  return AllMirrored(p.segments, q.segments) && AllMirrored(p.points, q.points);
}

bool AreMirrored(const std::optional<DepthMap>& p, const std::optional<DepthMap>& q) {
  if (!p || !q) return !p && !q;
  return p->origin == q->origin && p->cell == q->cell && p->columns == q->columns &&
         p->rows == q->rows && p->steepness == q->steepness &&
         std::equal(p->middle.begin(), p->middle.end(), q->middle.begin(), q->middle.end(),
                    [](float a, float b) { return a == -b; });
}

bool AreMirrored(const FieldPart& p, const FieldPart& q) {
  return p.z0 == -q.z0 && p.depth_scale == q.depth_scale && AreMirrored(p.depth, q.depth) &&
         std::equal(p.chains.begin(), p.chains.end(), q.chains.begin(), q.chains.end(),
                    [](const FieldChain& a, const FieldChain& b) { return AreMirrored(a, b); });
}

}  // namespace

bool IsMirrorSymmetric(const Field& field) {
  const std::vector<FieldPart>& parts = field.parts;
  std::vector<int> image(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    // Parents come first, so the image of this one's parent is known.
    std::optional<int> parent = parts[p].parent;
    if (parent) parent = image[static_cast<std::size_t>(*parent)];
    std::size_t q = 0;
    while (q < parts.size() && !(parts[q].parent == parent && AreMirrored(parts[p], parts[q]))) ++q;
    if (q == parts.size()) return false;
    image[p] = static_cast<int>(q);
  }
  return true;
}

}  // namespace lascaux

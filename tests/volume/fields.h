#pragma once

#include <cstdint>

#include "lascaux/field/field.h"

namespace lascaux::testing {

/// A sphere: its surface is exact.
Field SphereField(const Eigen::Vector3d& center, double radius);

/// A long segment: away from its ends exactly a cylinder.
Field CylinderField(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius);

/// A body of about 3 x 1 x 1 with a neck and a mirrored pair of legs; symmetric in z.
Field AnimalField();

/// Up to six capped chains of random place, direction and size in about 4 x 4 x 4, some of them
/// children of others; not symmetric.
Field RandomField(std::uint32_t seed);

/// The same field, with an empty part that has no mirror image: nothing may rely on symmetry.
Field WithoutMirror(Field field);

}  // namespace lascaux::testing

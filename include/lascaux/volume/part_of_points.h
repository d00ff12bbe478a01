#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/field/field.h"

/// @file
/// Which part of the field a place belongs to.

namespace lascaux {

/// Where no part reaches: the value of PartOfPoints for points at which the field is 0.
inline constexpr std::uint16_t kNoPart = 0xffff;

/// A part's field counts so many times its parent's. With as much, the border of a limb that lies
/// flush in the flank would be as ragged as chance: there both are as large over an area.
inline constexpr float kSayOfChild = 2;

/// For each point the index in Field::parts of the part whose own field counts most there, the
/// earlier one of equals.
///
/// `offset` is added to the points first. At most 65535 parts. Parts are compared in single
/// precision (kFloatValueError). About 0.1 us a point for points of a mesh or a grid: parts that
/// are far away are ruled out for whole runs of points that lie close together. The same bits for
/// any number of threads.
std::vector<std::uint16_t> PartOfPoints(const Field& field, std::span<const Eigen::Vector3f> points,
                                        const Eigen::Vector3d& offset,
                                        const Execution& execution = {});

}  // namespace lascaux

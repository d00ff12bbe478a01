#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "lascaux/volume/narrow_band.h"

/// @file
/// Axes of programs that are not ours.

namespace lascaux {

/// kY: the model's own axes. kZ: X = x, Y = -z, Z = y, a rotation that stands the model on the
/// plane z = 0.
enum class UpAxis : std::uint8_t { kY, kZ };

/// "Y", "Z".
constexpr const char* Name(UpAxis up) noexcept { return up == UpAxis::kY ? "Y" : "Z"; }

/// A point of the file's axes in the model's.
inline Eigen::Vector3d ToModelAxes(const Eigen::Vector3d& point, UpAxis up) {
  return up == UpAxis::kY ? point : Eigen::Vector3d(point.x(), point.z(), -point.y());
}

/// A band of the model's axes with z up. Exact: blocks are turned as wholes, every distance stays,
/// and what was at a voxel's centre still is. Turned back it is the same band with another number
/// for each voxel.
NarrowBand TurnedZUp(const NarrowBand& band);

}  // namespace lascaux

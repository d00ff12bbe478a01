#pragma once

#include <openvdb/openvdb.h>

#include <Eigen/Geometry>
#include <functional>

/// @file
/// Solids with a place that is too thin, in millimetres, as level sets.

namespace lascaux::testing {

using Distance = std::function<double(const Eigen::Vector3d&)>;

/// The level set of a signed distance within a box.
openvdb::FloatGrid::Ptr LevelSetOf(const Distance& distance, const Eigen::AlignedBox3d& box,
                                   double voxel_size);

inline constexpr double kThin = 0.6;   // how thick neck, leg and membrane are
inline constexpr double kVoxel = 0.2;  // of the shapes

/// Two balls of radius 8 around x = -14 and 14, joined by a cylinder.
openvdb::FloatGrid::Ptr Neck();

/// A ball of radius 8 around the origin with a cylinder down to y = -16.
openvdb::FloatGrid::Ptr Leg();

/// A ring (radii 10 and 2) around the z axis with a sheet in it.
openvdb::FloatGrid::Ptr Membrane();

/// A cone of 27 degrees with a point at x = 12 and a round end.
openvdb::FloatGrid::Ptr Spike();

}  // namespace lascaux::testing

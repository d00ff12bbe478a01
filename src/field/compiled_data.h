#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "block_kernel.h"
#include "flat_depth.h"
#include "lascaux/field/compiled_field.h"
#include "ricci.h"
#include "spline_table.h"

/// @file
/// What a CompiledField holds.

namespace lascaux {

/// A piece of a segment, or a point, in its part's flat space.
struct CompiledPrimitive {
  Eigen::Vector3d place;  ///< of the larger end, or of the point
  double radius = 0;      ///< there
  Eigen::AlignedBox3d box;
  float ux = 0, uy = 0, uz = 0;
  float slope = 0;
  float y_end = 0;
  float length = 0;    ///< in radii
  float least_radius;  ///< of both ends
  float norm = 0;      ///< of a point; 0 for a segment
  bool tip = false;    ///< the last piece of a tip, of any ratio of radii
  std::uint32_t chain = 0;

  bool is_point() const { return norm > 0; }
};

struct CompiledPart {
  int parent = -1;  ///< index in the compiled order
  std::uint32_t depth = 0;
  std::uint32_t end = 0;    ///< behind its last primitive
  Eigen::AlignedBox3d box;  ///< of its primitives, in its flat space
  double z0 = 0, inv_depth_scale = 1;
  std::optional<DepthMap> map;
  std::optional<internal::SplineTable> table;  ///< of the map
  double most_steepness = 1;                   ///< anywhere
};

/// Primitives in the order of their parts, chains, segments before points; parts parents first,
/// each followed by all that descends from it, so that one set of samples a depth is all that
/// blending needs.
struct CompiledField::Data {
  std::vector<CompiledPrimitive> primitives;
  std::vector<std::uint32_t> chain_part;
  std::vector<CompiledPart> parts;
  std::uint32_t depths = 1;
  internal::RicciExponent chain_exponent{1}, part_exponent{1};
  std::optional<internal::SplineTable> gain;
  Eigen::AlignedBox3d bounds;
  Isa isa = Isa::kBaseline;
  const internal::BlockKernel* kernel = nullptr;

  const CompiledPart& part_of(const CompiledPrimitive& primitive) const {
    return parts[chain_part[primitive.chain]];
  }
};

namespace internal {

/// `isa` must be supported.
const BlockKernel& KernelFor(Isa isa);

/// A place in the flat space of a part.
inline Eigen::Vector3d Flatten(const CompiledPart& part, const Eigen::Vector3d& place) {
  const double z = part.map ? FlatDepthOn(*part.map, part.z0, place).z
                            : part.z0 + (place.z() - part.z0) * part.inv_depth_scale;
  return {place.x(), place.y(), z};
}

}  // namespace internal
}  // namespace lascaux

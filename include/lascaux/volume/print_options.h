#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lascaux/volume/wall_thickness.h"

/// @file
/// How a model is made fit for a printer, and what was changed for it. Millimetres; y is up.

namespace lascaux {

/// kWhenItFalls: a plate under the feet of a model that would not stand safely.
enum class Base : std::uint8_t { kNone, kWhenItFalls };

struct PrintOptions {
  std::optional<double> min_wall;  ///< what is thinner becomes this thick
  Base base = Base::kNone;
  std::optional<double> hollow;  ///< thickness of the walls around a cavity

  bool Any() const noexcept { return min_wall || hollow || base != Base::kNone; }
  bool operator==(const PrintOptions&) const = default;
};

/// A flat plate whose outline, seen from above, is all that is within `margin` of a convex polygon,
/// with rounded edges.
struct Plate {
  std::vector<Eigen::Vector2d> hull;  ///< x and z; one or two corners are a point or a line
  double margin = 0;
  double bottom = 0, top = 0;

  /// Signed distance, negative inside.
  double Distance(const Eigen::Vector3d& p) const;

  /// What is seen of it from the side: a closed ring in x and y.
  std::vector<Eigen::Vector2d> SideView() const;
};

/// A cavity with a hole to the outside.
struct Cavity {
  double saved = 0;  ///< share of the filled solid's volume
  double drain = 0;  ///< width of the hole
  Eigen::Vector3d opening = Eigen::Vector3d::Zero();
};

/// What was changed; empty: nothing.
struct PrintChanges {
  std::vector<Wall> thickened;   ///< places that were thinner than PrintOptions::min_wall
  std::vector<Wall> still_thin;  ///< places that still are, by over 0.02 voxel
  std::optional<Plate> plate;
  std::optional<Cavity> cavity;
};

}  // namespace lascaux

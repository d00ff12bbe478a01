#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "json_values.h"
#include "lascaux/base/diagnostic.h"
#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"
#include "lascaux/volume/stability.h"
#include "lascaux/volume/wall_thickness.h"

namespace lascaux {

/// What somebody who prints a mesh wants to know beside its being a solid. Millimetres; y is up.
struct PrintFacts {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  std::optional<Wall> wall;  ///< the smallest, of any thickness
  ThinPlaces thin;           ///< below kThinWall
  std::string thin_part;     ///< of the thin wall, else of the thin tip
  std::string wall_part;     ///< name of the part that the smallest wall belongs to; empty: unknown
  std::optional<Stability> stability;
};

/// Walls thinner than this come out weak or not at all: a line and a half of a 0.5 mm nozzle.
inline constexpr double kThinWall = 0.8;

/// What is at most this much above the bed is pressed into the first layer.
inline constexpr double kContact = 0.3;

/// Measures a mesh whose unit is `millimetres` long. `details` may be without parts.
PrintFacts MeasureForPrint(const Mesh& mesh, const MeshDetails& details, double millimetres,
                           const Execution& execution = {});

/// Warnings "wall-thin" and "falls-over"; notes "tip-thin" where only tips are thin, and "leans"
/// where it rolls by 2 to 10 degrees.
Diagnostics PrintWarnings(const PrintFacts& facts);

/// The same as fields of a JSON object: size, smallest_wall, stability; null for what was not
/// measured.
Json PrintFactsJson(const std::optional<PrintFacts>& facts);

}  // namespace lascaux

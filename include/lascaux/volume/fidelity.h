#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh.h"

/// @file
/// Is the model, seen from the side, the drawing? Measured on the mesh's own silhouette.

namespace lascaux {

/// Distances are in percent of the diagonal of the drawn region.
struct Fidelity {
  double iou = 0;                   ///< of the mesh's side view and the drawn region
  double contour_mean_percent = 0;  ///< mean distance between the two outlines, the larger of both directions
  double contour_p95_percent = 0;   ///< its 95th percentile
  Eigen::Vector2d worst_at = Eigen::Vector2d::Zero();  ///< place of the largest distance, same frame as the region
  double worst_percent = 0;

  bool operator==(const Fidelity&) const = default;
};

/// Compares the mesh's projection along z with the union of `rings` (closed, in the mesh's own x and y).
///
/// Empty when either has no area.
std::optional<Fidelity> MeasureFidelity(const Mesh& mesh, const std::vector<std::vector<Eigen::Vector2d>>& rings,
                                        const Execution& execution = {});

}  // namespace lascaux

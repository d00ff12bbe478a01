#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh.h"

/// @file
/// Is the model, seen from the side, the drawing? Measured on the mesh's own silhouette.

namespace lascaux {

/// How far the model's outline is from what shows of one ring in the outline of the drawn region.
struct RingFidelity {
  double mean_percent = 0, p95_percent = 0, worst_percent = 0;
  double length = 0;  ///< of what shows, in the mesh's unit

  bool operator==(const RingFidelity&) const = default;
};

/// Distances are in percent of the diagonal of the drawn region's box.
struct Fidelity {
  double iou = 0;  ///< of the mesh's side view and the drawn region
  double contour_mean_percent =
      0;  ///< mean distance between the outlines, larger of both directions
  double contour_p95_percent = 0;  ///< its 95th percentile, larger of both directions
  Eigen::Vector2d worst_at =
      Eigen::Vector2d::Zero();  ///< where the largest distance is, in x and y
  double worst_percent = 0;
  std::vector<std::optional<RingFidelity>> rings;  ///< as many as there were; none where none shows

  bool operator==(const Fidelity&) const = default;
};

/// Compares the mesh's projection along z with the union of `rings` (closed, either way round, in
/// the mesh's own x and y).
///
/// Of each only the largest connected region counts, its holes below 1e-4 of its area filled. Both
/// are cut along 2000 lines a side of the box around them; where the lines cross an outline is
/// computed, not rounded to pixels, and each crossing stands for its share of the outline's length.
/// Figures are within 0.005 percent of the diagonal for outlines whose bends are wider than that.
///
/// Empty when either has no area or a coordinate is not finite, or when cancelled. About 10 ms for
/// 130 000 triangles. The same bits for any number of threads.
std::optional<Fidelity> MeasureFidelity(const Mesh& mesh,
                                        const std::vector<std::vector<Eigen::Vector2d>>& rings,
                                        const Execution& execution = {});

}  // namespace lascaux

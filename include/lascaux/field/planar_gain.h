#pragma once

#include <Eigen/Core>
#include <vector>

/// @file
/// A smooth factor over the xy plane that a field is multiplied by: what remains between the
/// silhouette and the drawing after the fit is taken away by it.
///
/// Source for the splines: C. de Boor, "A Practical Guide to Splines", 1978.

namespace lascaux {

/// log gain(x, y) as a uniform bicubic B-spline; 0 (no change) outside of the table.
struct PlanarGain {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< place of coefficient (0, 0)
  double cell = 1;                                   ///< distance of coefficients, > 0
  int columns = 0, rows = 0;
  std::vector<float> coefficients;  ///< rows of log gain, columns * rows

  float At(int column, int row) const {
    const bool inside = column >= 0 && column < columns && row >= 0 && row < rows;
    return inside ? coefficients[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                 static_cast<std::size_t>(column)]
                  : 0.0f;
  }

  bool operator==(const PlanarGain&) const = default;
};

/// log gain at a place and its derivatives by x and y.
struct LogGain {
  double value = 0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
};

/// Twice continuously differentiable; about 20 ns.
LogGain EvaluateLogGain(const PlanarGain& gain, const Eigen::Vector2d& place);

}  // namespace lascaux

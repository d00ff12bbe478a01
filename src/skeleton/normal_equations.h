#pragma once

#include <Eigen/Core>
#include <span>

#include "skeleton/planar_field.h"

/// @file
/// The sums of a least-squares problem whose rows are mostly 0.

namespace lascaux {

/// J^T W J and J^T W d. Of the matrix, the lower triangle; there is more room below it than it
/// needs.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd slope;

  explicit NormalEquations(int unknowns)
      : matrix(Eigen::MatrixXd::Zero(unknowns + 3, unknowns)),
        slope(Eigen::VectorXd::Zero(unknowns)) {}
};

/// One row of J, in runs as in PlanarSample.
struct SparseRow {
  std::span<const PlanarSample::Run> runs;
  std::span<const double> values;
  double weight, residual;
};

/// Adds a row. The same bits on every processor. Cost: the square of the values; 0.1 ns each with
/// AVX2.
void AddRow(const SparseRow& row, NormalEquations& sums);

}  // namespace lascaux

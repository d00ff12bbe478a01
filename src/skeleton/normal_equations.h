#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>

#include "skeleton/planar_field.h"

/// @file
/// The sums of a least-squares problem whose rows are mostly 0.

namespace lascaux {

/// Zeros whose pages exist once something is written to them: a matrix of thousands of unknowns is
/// nearly banded, and touched in full it would be gigabytes.
class LazyZeros {
 public:
  explicit LazyZeros(std::size_t count);

  double* data() const noexcept { return data_.get(); }

 private:
  struct Free {
    std::size_t mapped_bytes;  ///< 0: from calloc
    void operator()(double* data) const noexcept;
  };
  std::unique_ptr<double[], Free> data_;
};

/// J^T W J and J^T W d. Of the matrix, the lower triangle; there is more room below it than it
/// needs.
struct NormalEquations {
  int rows;
  LazyZeros zeros;
  Eigen::VectorXd slope;

  explicit NormalEquations(int unknowns)
      : rows(unknowns + 3),
        zeros(static_cast<std::size_t>(rows) * static_cast<std::size_t>(unknowns)),
        slope(Eigen::VectorXd::Zero(unknowns)) {}

  Eigen::Map<Eigen::MatrixXd> matrix() const { return {zeros.data(), rows, slope.size()}; }
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

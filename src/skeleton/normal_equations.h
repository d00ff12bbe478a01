#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "skeleton/index.h"
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
class NormalEquations {
 public:
  explicit NormalEquations(int unknowns);

  Eigen::VectorXd slope;

  /// Adds others of the same size.
  void Add(const NormalEquations& others);
  /// Back to 0. What is 0 costs nothing, here and in the others.
  void Clear();

  double Diagonal(int index) const { return zeros_.data()[(rows_ + 1) * Index(index)]; }

  /// Calls visit(row, value) for what is not 0 below a column's diagonal, downwards.
  template <typename Visit>
  void ForBelow(int column, const Visit& visit) const {
    ForBlocks(Index(column), [&](std::size_t first, const double* values) {
      for (std::size_t i = 0; i < kBlock; ++i) {
        const int row = static_cast<int>(first + i);
        if (row > column && values[i] != 0) visit(row, values[i]);
      }
    });
  }

  /// Where `count` rows of a column from `row` on are, which will be written to.
  double* At(std::size_t column, std::size_t row, std::size_t count) {
    for (std::size_t block = row / kBlock; block * kBlock < row + count; ++block)
      touched_[column * words_ + block / 64] |= std::uint64_t{1} << block % 64;
    return zeros_.data() + rows_ * column + row;
  }

 private:
  static constexpr std::size_t kBlock = 32;  ///< rows

  /// Calls visit(first row, its value) for the blocks of a column that were written to.
  template <typename Visit>
  void ForBlocks(std::size_t column, const Visit& visit) const {
    for (std::size_t w = 0; w < words_; ++w) {
      for (std::uint64_t bits = touched_[column * words_ + w]; bits != 0; bits &= bits - 1) {
        const std::size_t first =
            kBlock * (64 * w + static_cast<std::size_t>(std::countr_zero(bits)));
        visit(first, zeros_.data() + rows_ * column + first);
      }
    }
  }

  std::size_t rows_, words_;
  LazyZeros zeros_;
  std::vector<std::uint64_t> touched_;  ///< a bit for each block of each column
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

#include "skeleton/normal_equations.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "skeleton/index.h"

namespace lascaux {
namespace {

TEST(NormalEquations, AreThoseOfTheDenseMatrix) {
  constexpr int kUnknowns = 60;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> length(0, 5);
  NormalEquations sums(kUnknowns);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(kUnknowns);
  for (int round = 0; round < 50; ++round) {
    std::vector<PlanarSample::Run> runs;
    std::vector<double> values;
    Eigen::VectorXd dense = Eigen::VectorXd::Zero(kUnknowns);
    for (int chain = 0; chain < 3; ++chain) {  // the last one up to the last unknown
      const int vertices = length(random);
      runs.push_back({20 * (chain + 1) - 3 * vertices, 3 * vertices});
      for (int i = 0; i < runs.back().count; ++i)
        values.push_back(dense[runs.back().first + i] = uniform(random));
      values.resize(values.size() + Index(runs.back().FilledUp() - runs.back().count), 0);
    }
    const double weight = 1 + uniform(random), residual = uniform(random);
    AddRow({runs, values, weight, residual}, sums);
    matrix += weight * dense * dense.transpose();
    slope += weight * residual * dense;
  }
  const auto expect = [&](const NormalEquations& found, double times) {
    for (int column = 0; column < kUnknowns; ++column) {
      EXPECT_NEAR(found.slope[column], times * slope[column], 1e-12);
      EXPECT_NEAR(found.Diagonal(column), times * matrix(column, column), 1e-12);
      Eigen::VectorXd below = Eigen::VectorXd::Zero(kUnknowns);
      int last = column;
      found.ForBelow(column, [&](int row, double value) {
        EXPECT_GT(row, last);
        last = row;
        below[row] = value;
      });
      for (int row = column + 1; row < kUnknowns; ++row)
        EXPECT_NEAR(below[row], times * matrix(row, column), 1e-12) << row << ", " << column;
    }
  };
  expect(sums, 1);
  NormalEquations twice(kUnknowns);
  twice.Add(sums);
  twice.Add(sums);
  expect(twice, 2);
  twice.Clear();
  expect(twice, 0);
  twice.Add(sums);
  expect(twice, 1);
}

}  // namespace
}  // namespace lascaux

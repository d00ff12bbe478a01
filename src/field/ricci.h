#pragma once

#include <cmath>

/// @file
/// Powers and roots of one Ricci exponent.

namespace lascaux::internal {

/// x^n, x^(n-1) and x^(1/n): by multiplication and square roots where n is an integer or a power
/// of 2.
class RicciExponent {
 public:
  explicit RicciExponent(double n)
      : n_(n), integer_(n == std::floor(n) && n < 1024 ? static_cast<int>(n) : 0) {
    if (integer_ > 0 && (integer_ & (integer_ - 1)) == 0) {
      squarings_ = 0;
      for (int m = integer_; m > 1; m /= 2) ++squarings_;
    }
  }

  /// log2 n for powers of 2, otherwise -1.
  int squarings() const { return squarings_; }
  double n() const { return n_; }

  double Power(double x) const { return integer_ > 0 ? Repeat(x, integer_) : std::pow(x, n_); }
  double PowerLessOne(double x) const {
    return integer_ > 0 ? Repeat(x, integer_ - 1) : std::pow(x, n_ - 1);
  }
  double Root(double x) const {
    if (squarings_ < 0) return std::pow(x, 1 / n_);
    for (int i = 0; i < squarings_; ++i) x = std::sqrt(x);
    return x;
  }

 private:
  static double Repeat(double x, int times) {
    double product = 1;
    for (; times > 0; times /= 2, x *= x) {
      if (times % 2 == 1) product *= x;
    }
    return product;
  }

  double n_;
  int integer_;
  int squarings_ = -1;
};

}  // namespace lascaux::internal

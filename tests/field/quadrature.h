#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <vector>

#include "lascaux/field/primitives.h"

/// @file
/// The raw integral of a segment by adaptive quadrature in extended precision: what the closed
/// forms are held against.

namespace lascaux::testing {

using Real = long double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;

/// A value and a gradient in extended precision, of components that are integrated one by one.
struct Reference {
  Real value = 0;
  Vector3r gradient = Vector3r::Zero();
};

/// f and its gradient at `point`, to about 1e-14.
class SegmentReference {
 public:
  SegmentReference(const Segment& segment, const Eigen::Vector3d& point)
      : a_(segment.a.cast<Real>()), point_(point.cast<Real>()), tau_a_(segment.radius_a) {
    const Vector3r along = segment.b.cast<Real>() - a_;
    length_ = along.norm();
    direction_ = along / length_;
    slope_ = (Real(segment.radius_b) - tau_a_) / length_;
  }

  /// INT integrand(s) ds over the part of the segment where the kernel is positive.
  template <typename Integrand>
  Real Integrate(Integrand integrand) const {
    const std::vector<Real> breaks = Breaks();
    Real sum = 0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      if (Kernel((breaks[i] + breaks[i + 1]) / 2) <= 0) continue;
      sum += boost::math::quadrature::gauss_kronrod<Real, 31>::integrate(
          integrand, breaks[i], breaks[i + 1], 6, Real(1e-15));
    }
    return sum;
  }

  Real Tau(Real s) const { return tau_a_ + slope_ * s; }
  Vector3r Offset(Real s) const { return point_ - (a_ + s * direction_); }
  Real Kernel(Real s) const { return 1 - Offset(s).squaredNorm() / (4 * Tau(s) * Tau(s)); }
  Real length() const { return length_; }
  const Vector3r& direction() const { return direction_; }

  static Real Norm() { return 35 / (64 * std::pow(Real(0.75), Real(3.5))); }

  Reference Sample() const {
    Reference sample;
    sample.value = Norm() * Integrate([this](Real s) {
                     const Real p = Kernel(s);
                     return p * p * p / Tau(s);
                   });
    for (int i = 0; i < 3; ++i) {
      sample.gradient[i] = -Real(1.5) * Norm() * Integrate([this, i](Real s) {
        const Real p = Kernel(s), tau = Tau(s);
        return p * p * Offset(s)[i] / (tau * tau * tau);
      });
    }
    return sample;
  }

 private:
  /// Ends, roots of the kernel, and cuts that keep the radius within a factor of 2 on each
  /// interval.
  std::vector<Real> Breaks() const {
    std::vector<Real> breaks = {0, length_};
    const Vector3r w = point_ - a_;
    const Real x = w.dot(direction_), h2 = (w - x * direction_).squaredNorm();
    // 4 tau^2 - (s - x)^2 - h^2 = qa s^2 + 2 qb s + qc
    const Real qa = 4 * slope_ * slope_ - 1, qb = 4 * slope_ * tau_a_ + x;
    const Real qc = 4 * tau_a_ * tau_a_ - x * x - h2;
    const Real discriminant = qb * qb - qa * qc;
    if (discriminant >= 0) {
      const Real q = -(qb + std::copysign(std::sqrt(discriminant), qb));
      if (qa != 0) Add(q / qa, breaks);
      if (q != 0) Add(qc / q, breaks);
    }
    const Real ends[2] = {tau_a_, Tau(length_)};
    const Real large = std::max(ends[0], ends[1]), small = std::min(ends[0], ends[1]);
    for (Real tau = large / 2; tau > small && tau > large * Real(1e-9); tau /= 2) {
      Add((tau - tau_a_) / slope_, breaks);
    }
    std::sort(breaks.begin(), breaks.end());
    return breaks;
  }
  void Add(Real s, std::vector<Real>& breaks) const {
    if (s > 0 && s < length_) breaks.push_back(s);
  }

  Vector3r a_, point_, direction_;
  Real tau_a_, length_, slope_;
};

}  // namespace lascaux::testing

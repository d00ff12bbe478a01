#include "lascaux/field/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/cases.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using testing::ForSeeds;
using testing::Random;

/// The raw integral over q = corner + a side + b (other side): adaptive over a, and over b between
/// the roots of the kernel, where it is smooth.
class Reference {
 public:
  Reference(const Triangle& triangle, const Vector3d& point) : point_(point) {
    corner_ = triangle.corners[0];
    side_ = triangle.corners[1] - corner_, other_ = triangle.corners[2] - corner_;
    tau_ = triangle.radii[0];
    by_side_ = triangle.radii[1] - tau_, by_other_ = triangle.radii[2] - tau_;
    area_ = side_.cross(other_).norm();
  }

  /// INT integrand(kernel, offset, radius) dA where the kernel is positive.
  template <typename Integrand>
  double Integrate(Integrand integrand) const {
    const auto inner = [&](double a) { return Inner(a, integrand); };
    // Cuts that close in on the point's foot, or the support could be missed.
    const Vector3d across = side_ - side_.dot(other_) / other_.squaredNorm() * other_;
    const double foot = (point_ - corner_).dot(across) / across.squaredNorm();
    std::vector<double> cuts = {0, 1};
    const double least = std::min({tau_, tau_ + by_side_, tau_ + by_other_}) / across.norm();
    for (double step = 1; step > std::max(least, 1e-5); step /= 8) {
      for (const double cut : {foot - step, foot + step}) {
        if (cut > 0 && cut < 1) cuts.push_back(cut);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(inner, cuts[i],
                                                                           cuts[i + 1], 8, 1e-11);
    }
    return area_ * sum;
  }

  double Value() const {
    return kNorm *
           Integrate([](double k, const Vector3d&, double tau) { return k * k * k / (tau * tau); });
  }
  Vector3d Gradient() const {
    Vector3d gradient;
    for (int i = 0; i < 3; ++i) {
      gradient[i] = -1.5 * kNorm * Integrate([i](double k, const Vector3d& offset, double tau) {
        return k * k * offset[i] / (tau * tau * tau * tau);
      });
    }
    return gradient;
  }

 private:
  template <typename Integrand>
  double Inner(double a, Integrand& integrand) const {
    const Vector3d way = point_ - corner_ - a * side_;
    const double tau = tau_ + a * by_side_, length = 1 - a;
    // 4 (tau + by b)^2 - |way - b other|^2 = 0
    const double qa = 4 * by_other_ * by_other_ - other_.squaredNorm();
    const double qb = 4 * tau * by_other_ + way.dot(other_);
    const double qc = 4 * tau * tau - way.squaredNorm();
    std::vector<double> breaks = {0, length};
    const auto add = [&](double b) {
      if (b > 0 && b < length) breaks.push_back(b);
    };
    const double discriminant = qb * qb - qa * qc;
    if (discriminant >= 0) {
      const double q = -(qb + std::copysign(std::sqrt(discriminant), qb));
      if (qa != 0) add(q / qa);
      if (q != 0) add(qc / q);
    }
    const double ends[2] = {tau, tau + by_other_ * length};
    const double large = std::max(ends[0], ends[1]), small = std::min(ends[0], ends[1]);
    for (double t = large / 2; t > small && t > 1e-9 * large; t /= 2) add((t - tau) / by_other_);
    std::sort(breaks.begin(), breaks.end());
    const auto at = [&](double b) {
      const Vector3d offset = way - b * other_;
      const double here = tau + by_other_ * b;
      return integrand(Kernel(offset, here), offset, here);
    };
    double sum = 0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double middle = (breaks[i] + breaks[i + 1]) / 2;
      if (Kernel(way - middle * other_, tau + by_other_ * middle) <= 0) continue;
      sum += boost::math::quadrature::gauss<double, 20>::integrate(at, breaks[i], breaks[i + 1]);
    }
    return sum;
  }
  static double Kernel(const Vector3d& offset, double tau) {
    return 1 - offset.squaredNorm() / (4 * tau * tau);
  }

  static constexpr double kNorm = 256 / (81 * std::numbers::pi);

  Vector3d point_, corner_, side_, other_;
  double tau_, by_side_, by_other_, area_;
};

Triangle RandomTriangle(Random& random, double size, double ratio) {
  Triangle triangle;
  const auto place = [&] { return Vector3d(size * random.Direction()); };
  do {
    triangle.corners = {place(), place(), place()};
  } while ((triangle.corners[1] - triangle.corners[0])
               .cross(triangle.corners[2] - triangle.corners[0])
               .norm() < 0.02 * size * size);
  for (double& radius : triangle.radii) radius = random.LogUniform(1 / ratio, 1);
  if (random.Chance(0.1)) triangle.radii[1] = triangle.radii[0];
  if (random.Chance(0.1)) triangle.radii = {1, 1, 1};
  return triangle;
}

Vector3d PointNear(Random& random, const Triangle& triangle) {
  const double a = random.Uniform(0, 1), b = random.Uniform(0, 1 - a), c = 1 - a - b;
  const auto& p = triangle.corners;
  const double radius = a * triangle.radii[0] + b * triangle.radii[1] + c * triangle.radii[2];
  const double away = random.Chance(0.1) ? 0 : random.Uniform(0, 2.2);
  return a * p[0] + b * p[1] + c * p[2] + away * radius * random.Direction();
}

/// The gradient of some, for its reference takes four times as long.
void ExpectExact(const Triangle& triangle, const Vector3d& point, bool with_gradient) {
  const Reference reference(triangle, point);
  const FieldSample found = Evaluate(triangle, point);
  const double exact = reference.Value();
  ASSERT_NEAR(found.value, exact, kTriangleValueError * std::max(exact, 0.05));
  if (!with_gradient) return;
  const Vector3d gradient = reference.Gradient();
  const double largest = *std::max_element(triangle.radii.begin(), triangle.radii.end());
  ASSERT_LE((found.gradient - gradient).norm(),
            kTriangleGradientError * (gradient.norm() + 0.05 / largest))
      << found.gradient.transpose() << " for " << gradient.transpose();
}

TEST(Triangle, AgreesWithQuadratureForEverySizeAndRatio) {
  for (const double size : {0.02, 0.5, 1.0, 3.0, 20.0}) {
    for (const double ratio : {1.01, 3.0, 100.0}) {
      SCOPED_TRACE(::testing::Message() << "size " << size << ", ratio " << ratio);
      ForSeeds(140, [&](Random& random) {
        const Triangle triangle = RandomTriangle(random, size, ratio);
        const Vector3d point = PointNear(random, triangle);
        ExpectExact(triangle, point, random.Chance(0.2));
      });
    }
  }
}

TEST(Triangle, AgreesWithQuadratureNearTips) {
  ForSeeds(150, [](Random& random) {
    Triangle triangle = RandomTriangle(random, 2, 2);
    triangle.radii[static_cast<std::size_t>(random.Integer(0, 2))] = 0;
    const Vector3d point = PointNear(random, triangle);
    ExpectExact(triangle, point, random.Chance(0.2));
  });
}

TEST(Triangle, ALargeSheetIsAsThickAsItsRadiusAndEndsAThirdBeyondItsEdge) {
  const Triangle sheet = {{Vector3d(-50, 0, 0), Vector3d(50, 0, 0), Vector3d(0, 90, 0)}, {2, 2, 2}};
  const FieldSample above = Evaluate(sheet, {0, 30, 2});
  EXPECT_NEAR(above.value, 1, 1e-12);
  EXPECT_NEAR(above.gradient.z(), -4 / 3.0, 1e-12);  // (1 - h^2 / 4)^4 by h, over (3/4)^4, / radius
  EXPECT_LE(above.gradient.head<2>().norm(), 1e-12);
  EXPECT_NEAR(Evaluate(sheet, {0, 0, 0}).value, 1.580, 1e-3);  // half of the (4/3)^4 inside
  double low = 0, high = 2;
  for (int i = 0; i < 40; ++i) {
    const double half = (low + high) / 2;
    (Evaluate(sheet, {0, -half, 0}).value > 1 ? low : high) = half;
  }
  EXPECT_NEAR(low / 2, 0.325, 1e-3);
}

TEST(Triangle, PiecesAddUpAndNeitherScaleNorOrderChangesAnything) {
  ForSeeds(500, [](Random& random) {
    const Triangle whole = RandomTriangle(random, random.LogUniform(0.1, 10), 10);
    const Vector3d point = PointNear(random, whole);
    const FieldSample sample = Evaluate(whole, point);
    const double t = random.Uniform(0.05, 0.95);
    const Vector3d cut = whole.corners[0] + t * (whole.corners[1] - whole.corners[0]);
    const double radius = whole.radii[0] + t * (whole.radii[1] - whole.radii[0]);
    const FieldSample one = Evaluate(Triangle{{whole.corners[0], cut, whole.corners[2]},
                                              {whole.radii[0], radius, whole.radii[2]}},
                                     point);
    const FieldSample two = Evaluate(Triangle{{cut, whole.corners[1], whole.corners[2]},
                                              {radius, whole.radii[1], whole.radii[2]}},
                                     point);
    const double steepness = sample.gradient.norm() + 0.05;
    ASSERT_NEAR(one.value + two.value, sample.value,
                3 * kTriangleValueError * std::max(sample.value, 0.05));
    ASSERT_LE((one.gradient + two.gradient - sample.gradient).norm(),
              3 * kTriangleGradientError * steepness);
    for (const double scale : {1e-12, 1e12}) {
      Triangle scaled = {
          {scale * whole.corners[2], scale * whole.corners[0], scale * whole.corners[1]},
          {scale * whole.radii[2], scale * whole.radii[0], scale * whole.radii[1]}};
      const FieldSample there = Evaluate(scaled, scale * point);
      ASSERT_NEAR(there.value, sample.value,
                  2 * kTriangleValueError * std::max(sample.value, 0.05));
      ASSERT_LE((scale * there.gradient - sample.gradient).norm(),
                2 * kTriangleGradientError * steepness);
    }
  });
}

TEST(Triangle, IsFiniteEverywhereAndZeroOutsideOfItsBox) {
  ForSeeds(500, [](Random& random) {
    Triangle triangle = RandomTriangle(random, random.LogUniform(1e-3, 1e3), 1e6);
    if (random.Chance(0.2)) triangle.radii[0] = 0;
    if (random.Chance(0.1)) triangle.corners[1] = triangle.corners[0];
    if (random.Chance(0.1)) triangle.corners[1] = triangle.corners[0] + 1e-12 * random.Direction();
    Eigen::AlignedBox3d larger = Bounds(triangle);
    const Eigen::AlignedBox3d box = larger;
    if (larger.isEmpty()) larger = {Vector3d(-1, -1, -1), Vector3d(1, 1, 1)};
    larger.min().array() -= 1, larger.max().array() += 1;
    for (int k = 0; k < 20; ++k) {
      const Vector3d point =
          k < 3 ? triangle.corners[static_cast<std::size_t>(k)] : random.InBox(larger);
      const FieldSample sample = Evaluate(triangle, point);
      ASSERT_TRUE(std::isfinite(sample.value) && sample.gradient.allFinite());
      ASSERT_GE(sample.value, 0);
      if (!box.contains(point)) {
        ASSERT_LE(sample.value, 1e-14);
      }
    }
  });
}

TEST(Triangle, WithoutAreaOrRadiusContributesNothing) {
  const Triangle line = {{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(3, 0, 0)}, {1, 1, 1}};
  const Triangle nothing = {{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}, {0, 0, 0}};
  for (const Triangle& triangle : {line, nothing}) {
    EXPECT_EQ(Evaluate(triangle, {0.1, 0.1, 0}).value, 0);
    EXPECT_TRUE(Bounds(triangle).isEmpty());
  }
}

}  // namespace
}  // namespace lascaux

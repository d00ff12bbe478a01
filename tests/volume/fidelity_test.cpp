#include "lascaux/volume/fidelity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "volume/shapes.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::Moved;
using testing::OnThreads;
using testing::Sphere;
using testing::Tetrahedron;
using testing::Together;
using Ring = std::vector<Vector2d>;

Ring Circle(double radius, const Vector2d& center = Vector2d::Zero()) {
  Ring ring;
  for (int i = 0; i < 2000; ++i) {
    const double t = 2 * std::numbers::pi * i / 2000;
    ring.push_back(center + radius * Vector2d(std::cos(t), std::sin(t)));
  }
  return ring;
}

Ring Box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A box from (0, 0, -1) to (width, height, 1).
Mesh Cuboid(float width, float height) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? width : 0.0F, (i & 2) != 0 ? height : 0.0F,
                               (i & 4) != 0 ? 1.0F : -1.0F);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(MeasureFidelity, AShapeMatchesItself) {
  const auto sphere = MeasureFidelity(Sphere(7), {Circle(1)});
  ASSERT_TRUE(sphere);
  EXPECT_GT(sphere->iou, 0.9998);
  EXPECT_LT(sphere->contour_mean_percent, 0.002);
  EXPECT_LT(sphere->worst_percent, 0.01);
  const auto box = MeasureFidelity(Cuboid(3, 2), {Box(0, 0, 3, 2)});
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->iou, 1, 1e-9);
  EXPECT_NEAR(box->contour_mean_percent, 0, 1e-9);
}

TEST(MeasureFidelity, ALargerCircleIsEverywhereAsFarAway) {
  const auto found = MeasureFidelity(Sphere(7), {Circle(1.05)});
  ASSERT_TRUE(found);
  const double percent = 100 * 0.05 / (2 * 1.05 * std::numbers::sqrt2);
  EXPECT_NEAR(found->iou, 1 / (1.05 * 1.05), 2e-4);
  EXPECT_NEAR(found->contour_mean_percent, percent, 0.003);
  EXPECT_NEAR(found->contour_p95_percent, percent, 0.005);
  EXPECT_NEAR(found->worst_percent, percent, 0.01);
}

TEST(MeasureFidelity, AShiftedSquareIsHalfTheShiftAway) {
  // Left and right sides lie off by s or the way to the nearest corner: 2 s over a perimeter of 4.
  for (const double s : {0.01, 0.1, 0.25}) {
    const auto found = MeasureFidelity(Cuboid(1, 1), {Box(s, 0, 1 + s, 1)});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->iou, (1 - s) / (1 + s), 1e-3) << s;
    EXPECT_NEAR(found->contour_mean_percent, 100 * s / 2 / std::numbers::sqrt2, 0.01) << s;
    EXPECT_NEAR(found->worst_percent, 100 * s / std::numbers::sqrt2, 0.01) << s;
  }
}

TEST(MeasureFidelity, TheWorstPlaceIsWhereSomethingIsMissing) {
  Ring ring = Box(0, 0, 3, 2);
  ring.insert(ring.begin() + 2, {{3, 1.1}, {3.5, 1.1}, {3.5, 0.9}, {3, 0.9}});
  std::reverse(ring.begin() + 2, ring.begin() + 6);
  const auto found = MeasureFidelity(Cuboid(3, 2), {ring});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->worst_at.x(), 3.5, 0.01);
  EXPECT_NEAR(found->worst_at.y(), 1, 0.11);
  EXPECT_NEAR(found->worst_percent, 100 * 0.5 / std::hypot(3.5, 2), 0.02);
}

TEST(MeasureFidelity, RingsOverlapEitherWayRound) {
  Ring left = Box(0, 0, 2, 2), right = Box(1, 0, 3, 2);
  std::reverse(right.begin(), right.end());
  const auto found = MeasureFidelity(Cuboid(3, 2), {left, right});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->iou, 1, 1e-9);
  EXPECT_NEAR(found->worst_percent, 0, 1e-9);
}

TEST(MeasureFidelity, SpecksAndPinholesDoNotCount) {
  // Abutting rings leave a hair between them; a dot lies beside.
  const std::vector<Ring> rings = {Box(0, 0, 1.5, 2), Box(1.5, 0, 3, 0.9), Box(1.50001, 0.9, 3, 2),
                                   Box(2.999, 0, 3, 2), Box(5, 5, 5.01, 5.01)};
  const auto found = MeasureFidelity(Cuboid(3, 2), rings);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->iou, 1, 1e-3);
  EXPECT_LT(found->contour_mean_percent, 0.01);
}

TEST(MeasureFidelity, HolesOfTheSilhouetteAreItsOutlineToo) {
  const auto found = MeasureFidelity(testing::Torus(300, 2, 0.7F), {Box(-2.7, -0.7, 2.7, 0.7)});
  ASSERT_TRUE(found);  // seen along z, a torus around y has no hole
  EXPECT_GT(found->iou, 0.85);
  Mesh ring = testing::Torus(300, 2, 0.7F);
  for (auto& v : ring.vertices) v = {v.x(), -v.z(), v.y()};
  const auto hole = MeasureFidelity(ring, {Circle(2.7)});
  ASSERT_TRUE(hole);
  EXPECT_NEAR(hole->iou, 1 - std::pow(1.3 / 2.7, 2), 1e-3);
  EXPECT_NEAR(hole->worst_percent, 100 * 1.4 / (5.4 * std::numbers::sqrt2), 0.05);
}

TEST(MeasureFidelity, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = Moved(Sphere(5), 0.1F, 0.05F, 0);
  EXPECT_EQ(MeasureFidelity(mesh, {Circle(1)}, OnThreads(1)),
            MeasureFidelity(mesh, {Circle(1)}, OnThreads(2)));
}

TEST(MeasureFidelity, NothingIsMeasuredWithoutArea) {
  EXPECT_FALSE(MeasureFidelity({}, {Circle(1)}));
  EXPECT_FALSE(MeasureFidelity(Sphere(2), {}));
  EXPECT_FALSE(MeasureFidelity(Sphere(2), {{}, {{0, 0}}, {{1, 1}, {2, 2}}}));
  EXPECT_FALSE(MeasureFidelity(Cuboid(0, 1), {Circle(1)}));
  Mesh broken = Sphere(2);
  broken.vertices[0].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(MeasureFidelity(broken, {Circle(1)}));
  broken = Sphere(2);
  broken.triangles[0][0] = 1'000'000;
  EXPECT_FALSE(MeasureFidelity(broken, {Circle(1)}));
  EXPECT_FALSE(MeasureFidelity(Sphere(2), {{{0, 0}, {1, 0}, {0, std::nan("")}}}));
}

TEST(MeasureFidelity, StopsWhenCancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_FALSE(MeasureFidelity(Sphere(2), {Circle(1)}, testing::CancelledBy(cancel)));
}

}  // namespace
}  // namespace lascaux

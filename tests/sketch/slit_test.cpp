#include "sketch/map/slit.h"

#include <gtest/gtest.h>

#include "lascaux/sketch/planar_map.h"
#include "sketch/map/arrangement.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::ForSeeds;
using testing::Random;

/// Every pair of points, one after the other: what the grid has to find.
std::optional<Slit> NarrowestOfAllPairs(const OuterWalk& walk, const SlitSearch& search) {
  std::optional<Slit> best;
  for (std::size_t i = 0; i < walk.points.size(); ++i) {
    for (std::size_t j = i + 1; j < walk.points.size(); ++j) {
      const Vector2d p = walk.points[i].position, q = walk.points[j].position;
      const double width = (q - p).norm();
      if (width == 0 || width > search.reach || (best && width >= best->width)) continue;
      if (walk.Along(i, j) < search.least_along) continue;
      if (walk.FaceArea(i, j) < search.least_area) continue;
      best = p.x() <= q.x() ? Slit{p, q, width} : Slit{q, p, width};
    }
  }
  return best;
}

/// Lines without an inside: a wandering one, and hairs from it.
std::vector<OuterWalk> Walks(Random& random, double spacing) {
  std::vector<ArrangementLine> lines(1);
  Vector2d p(0, 0);
  double heading = 0;
  for (int i = 0; i < 60; ++i) {
    lines[0].points.push_back(p);
    heading += random.Uniform(-0.8, 0.9);
    p += 10 * Vector2d(std::cos(heading), std::sin(heading));
    if (!random.Chance(0.3)) continue;
    lines.push_back({{p, p + Vector2d(random.Uniform(-9, 9), random.Uniform(1, 40))}});
  }
  const auto map = Arrange(lines, 200);
  return map ? OuterWalks(*map, spacing) : std::vector<OuterWalk>{};
}

TEST(Slit, IsTheNarrowestOfAllPairsOfPoints) {
  int found = 0, missing = 0;
  ForSeeds(60, [&](Random& random) {
    const double reach = random.Uniform(1, 8);
    const SlitSearch search{
        .reach = reach, .least_along = 8 * reach, .least_area = random.LogUniform(1, 3000)};
    for (const OuterWalk& walk : Walks(random, reach / 4)) {
      const auto expected = NarrowestOfAllPairs(walk, search);
      const auto slit = NarrowestSlit(walk, search);
      ASSERT_EQ(slit.has_value(), expected.has_value());
      ++(slit ? found : missing);
      if (!slit) continue;
      EXPECT_EQ(slit->width, expected->width);
      EXPECT_EQ(slit->from, expected->from);
      EXPECT_EQ(slit->to, expected->to);
    }
  });
  // Both happen, or the test compares nothing.
  EXPECT_GE(found, 10);
  EXPECT_GE(missing, 10);
}

}  // namespace
}  // namespace lascaux

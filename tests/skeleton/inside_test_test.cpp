#include "skeleton/inside_test.h"

#include <gtest/gtest.h>

#include <random>

#include "lascaux/sketch/parts.h"

namespace lascaux {
namespace {

TEST(InsideTest, AnswersAsContainsDoes) {
  std::mt19937 random(7);
  // On a coarse lattice many points are as high as corners, and edges are level.
  std::uniform_int_distribution<int> corner(0, 8), twice(-2, 18);
  for (int size : {0, 1, 2, 3, 4, 10, 200}) {
    for (int round = 0; round < 20; ++round) {
      Ring ring;
      for (int i = 0; i < size; ++i) ring.emplace_back(corner(random), corner(random));
      if (round == 0) ring.assign(ring.size(), Eigen::Vector2d(1, 2));
      const InsideTest test(ring);
      for (int i = 0; i < 200; ++i) {
        const Eigen::Vector2d point(twice(random) / 2.0, twice(random) / 2.0);
        EXPECT_EQ(test.Contains(point), !ring.empty() && Contains(ring, point));
      }
    }
  }
}

}  // namespace
}  // namespace lascaux

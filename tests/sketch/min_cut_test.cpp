#include "sketch/map/min_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;

struct Link {
  int a = 0, b = 0;
  std::int64_t there = 0, back = 0;
};

std::int64_t CostOf(const std::vector<Link>& links, const std::vector<bool>& source_side) {
  std::int64_t cost = 0;
  for (const Link& link : links) {
    const bool a = source_side[static_cast<std::size_t>(link.a)],
               b = source_side[static_cast<std::size_t>(link.b)];
    if (a && !b) cost += link.there;
    if (b && !a) cost += link.back;
  }
  return cost;
}

TEST(MinCut, NoOtherCutIsCheaperInRandomGraphs) {
  ForSeeds(200, [&](Random& random) {
    constexpr int kNodes = 8;
    std::vector<Link> links;
    CutGraph graph(kNodes);
    for (int k = random.Integer(4, 24); k > 0; --k) {
      const int a = random.Integer(0, kNodes - 1), b = random.Integer(0, kNodes - 1);
      if (a == b) continue;
      links.push_back({a, b, random.Integer(0, 9), random.Integer(0, 9)});
      graph.Link(a, b, links.back().there, links.back().back);
    }
    const std::vector<bool> side = graph.SourceSide(0, kNodes - 1);
    ASSERT_TRUE(side.front());
    ASSERT_FALSE(side.back());
    const std::int64_t cost = CostOf(links, side);
    for (int bits = 0; bits < 1 << (kNodes - 2); ++bits) {
      std::vector<bool> other(kNodes, false);
      other.front() = true;
      for (int i = 1; i < kNodes - 1; ++i)
        other[static_cast<std::size_t>(i)] = (bits >> (i - 1) & 1) != 0;
      ASSERT_GE(CostOf(links, other), cost);
    }
  });
}

TEST(MinCut, OfEqualCutsTheSmallestSourceSideIsTaken) {
  CutGraph graph(3);
  graph.Link(0, 1, 5, 0);
  graph.Link(1, 2, 5, 0);
  EXPECT_EQ(graph.SourceSide(0, 2), (std::vector<bool>{true, false, false}));
}

}  // namespace
}  // namespace lascaux

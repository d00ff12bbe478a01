#include "lascaux/sketch/depth_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sketch/drawings.h"

namespace lascaux {
namespace {

using namespace testing;
using Eigen::Vector2d;

struct Read {
  Parts parts;
  DepthGraph graph;

  /// The smallest part of a role around a point.
  std::optional<int> At(PartRole role, const Vector2d& point) const {
    std::optional<int> best;
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      if (graph.nodes[i].role == role && Contains(parts.parts[i].outline.points, point))
        best = static_cast<int>(i);
    }
    return best;
  }
  const DepthNode& Node(int i) const { return graph.nodes[static_cast<std::size_t>(i)]; }
};

Read ReadOf(const Sketch& sketch, const OrderByDepthOptions& options = {}) {
  const auto map = BuildPlanarMap(sketch);
  EXPECT_TRUE(map);
  Read read{*FindParts(*map), {}};
  const auto graph = OrderByDepth(*map, read.parts, options);
  EXPECT_TRUE(graph);
  read.graph = *graph;
  return read;
}

TEST(DepthGraph, TorsoIsTheBody) {
  const Read read = ReadOf(Quadruped());
  const auto body = read.At(PartRole::kBody, {250, 120});
  ASSERT_TRUE(body);
  EXPECT_EQ(*body, read.graph.body);
  EXPECT_GT(read.graph.body_margin, 0.5);
  EXPECT_FALSE(read.Node(*body).parent);
}

TEST(DepthGraph, NearAndFarLegAreAPairOverAndUnderTheBody) {
  const Read read = ReadOf(Quadruped());
  const auto near = read.At(PartRole::kForeground, {125, 260}),
             far = read.At(PartRole::kBackground, {175, 280});
  ASSERT_TRUE(near && far);
  EXPECT_EQ(read.Node(*near).pair, far);
  EXPECT_EQ(read.Node(*far).pair, near);
  EXPECT_EQ(read.Node(*near).relation, Relation::kOver);
  EXPECT_EQ(read.Node(*far).relation, Relation::kUnder);
  EXPECT_EQ(read.Node(*near).parent, read.graph.body);
}

TEST(DepthGraph, TailIsAdjacentInThePlane) {
  const Read read = ReadOf(Quadruped());
  const auto tail = read.At(PartRole::kSagittal, {440, 90});
  ASSERT_TRUE(tail);
  EXPECT_EQ(read.Node(*tail).relation, Relation::kAdjacent);
  EXPECT_EQ(read.Node(*tail).parent, read.graph.body);
}

TEST(DepthGraph, EyeLiesOverAndInTheBody) {
  const Read read = ReadOf(Quadruped());
  const auto eye = read.At(PartRole::kIsland, {60, 100});
  ASSERT_TRUE(eye);
  EXPECT_EQ(read.Node(*eye).relation, Relation::kOverIn);
  EXPECT_EQ(read.Node(*eye).parent, read.graph.body);
}

TEST(DepthGraph, ParentsComeFirstAndNamesAreUnique) {
  const Read read = ReadOf(Quadruped());
  std::vector<int> seen;
  std::vector<std::string> names;
  for (const int i : read.graph.order) {
    const DepthNode& node = read.Node(i);
    if (node.parent) {
      EXPECT_NE(std::find(seen.begin(), seen.end(), *node.parent), seen.end());
    }
    seen.push_back(i);
    EXPECT_EQ(std::count(names.begin(), names.end(), node.name), 0) << node.name;
    names.push_back(node.name);
  }
  EXPECT_EQ(seen.size(), read.graph.nodes.size());
}

TEST(DepthGraph, PointChoosesTheBody) {
  OrderByDepthOptions options;
  options.body = Vector2d(440, 90);  // in the tail
  const Read read = ReadOf(Quadruped(), options);
  EXPECT_TRUE(read.At(PartRole::kBody, {440, 90}));
  EXPECT_TRUE(read.At(PartRole::kSagittal, {250, 120}));
}

TEST(DepthGraph, PointOutsideOfEverythingIsAnErrorThere) {
  const auto map = BuildPlanarMap(Quadruped());
  ASSERT_TRUE(map);
  OrderByDepthOptions options;
  options.body = Vector2d(-50, -50);
  const auto graph = OrderByDepth(*map, *FindParts(*map), options);
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.diagnostics().back().code, "body-not-there");
  EXPECT_EQ(graph.diagnostics().back().at, options.body);
}

TEST(DepthGraph, PartsWithoutABorderHaveNoBody) {
  const auto map = BuildPlanarMap(Quadruped());
  ASSERT_TRUE(map);
  const auto graph = OrderByDepth(*map, Parts{});
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.diagnostics().back().code, "no-body");
}

TEST(DepthGraph, MirroredDrawingHasTheSameRoles) {
  const Read a = ReadOf(Quadruped()), b = ReadOf(Mirrored(Quadruped()));
  for (const PartRole role : {PartRole::kBody, PartRole::kForeground, PartRole::kBackground,
                              PartRole::kSagittal, PartRole::kIsland}) {
    const auto count = [&](const Read& read) {
      return std::count_if(read.graph.nodes.begin(), read.graph.nodes.end(),
                           [&](const DepthNode& n) { return n.role == role; });
    };
    EXPECT_EQ(count(a), count(b)) << Name(role);
  }
}

}  // namespace
}  // namespace lascaux

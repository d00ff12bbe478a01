#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <tuple>

#include "lascaux/sketch/depth_graph.h"
#include "sketch/drawings.h"
#include "sketch/svg_text.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::CountOf;
using testing::Path;
using testing::Points;
using testing::Quadruped;
using testing::Svg;

const std::string kBlack = "stroke='none' fill='black' ";

Points PointsOf(const Stroke& stroke, double tolerance) {
  Points points{stroke.pieces.front().p[0]};
  for (const CubicBezier& piece : stroke.pieces) {
    for (const CurveSample& sample : Flatten(piece, tolerance)) {
      if (sample.point != points.back()) points.push_back(sample.point);
    }
  }
  return points;
}

std::string Polygon(const Points& points) {
  std::ostringstream out;
  for (const Vector2d& p : points)
    out << (&p == &points.front() ? 'M' : 'L') << p.x() << ' ' << p.y();
  return out.str() + "Z ";
}

/// A round pen's ink along a stroke as contours that overlap: a disc at each point, and a band
/// between them, all in one direction.
std::string Inked(const Stroke& stroke, double width) {
  constexpr int kCorners = 16;
  const Points points = PointsOf(stroke, 0.05 * width);
  std::string d;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Points disc;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2 * std::numbers::pi * k / kCorners;
      disc.push_back(points[i] + 0.5 * width * Vector2d(std::cos(angle), std::sin(angle)));
    }
    d += Polygon(disc);
    if (i == 0) continue;
    const Vector2d &a = points[i - 1], &b = points[i], along = (b - a).normalized();
    const Vector2d side = 0.5 * width * Vector2d(-along.y(), along.x());
    d += Polygon({a - side, b - side, b + side, a + side});
  }
  return d;
}

/// All of a drawing's ink as one filled shape.
std::string InkedPage(const Sketch& sketch, double width) {
  std::string d;
  for (const Stroke& stroke : sketch.strokes) d += Inked(stroke, width);
  return Svg(Path(d, kBlack));
}

Sketch Example(const std::string& name) {
  std::ifstream in(std::filesystem::path(LASCAUX_EXAMPLES) / (name + ".svg"), std::ios::binary);
  return *ReadSvg(std::string{std::istreambuf_iterator<char>(in), {}});
}

const Stroke& Longest(const Sketch& sketch) {
  const auto pieces = [](const Stroke& a, const Stroke& b) {
    return a.pieces.size() < b.pieces.size();
  };
  return *std::max_element(sketch.strokes.begin(), sketch.strokes.end(), pieces);
}

/// How many parts have which role and relation, with a partner or without.
std::map<std::tuple<PartRole, Relation, bool>, int> PartsOf(const Sketch& sketch) {
  const auto map = BuildPlanarMap(sketch);
  const auto parts = FindParts(*map);
  const auto graph = OrderByDepth(*map, *parts);
  std::map<std::tuple<PartRole, Relation, bool>, int> count;
  for (const DepthNode& node : graph->nodes) {
    if (node.role != PartRole::kIgnored) ++count[{node.role, node.relation, node.pair.has_value()}];
  }
  return count;
}

TEST(InkOutlines, DrawingsOfInkHaveTheirPensParts) {
  for (const char* name : {"elephant", "giraffe", "horse", "tortoise"}) {
    const Sketch drawn = Example(name);
    const double width = 0.005 * Bounds(drawn).diagonal().norm();
    const Outcome<Sketch> read = ReadSvg(InkedPage(drawn, width));
    EXPECT_EQ(testing::WrongWith(read), "") << name;
    ASSERT_EQ(CountOf(read, "ink-outlines"), 1) << name;
    EXPECT_NEAR(Longest(*read).width, width, 0.1 * width) << name;
    EXPECT_EQ(PartsOf(*read), PartsOf(drawn)) << name;
  }
}

TEST(InkOutlines, ColoredAreasOnBlackLeaveLines) {
  // A black body, a colored one on it, less by the pen's width.
  const auto page = [](const std::string& inner, const std::string& hair) {
    return Svg(Path("M0 0H200V100H0Z", "fill='black' " + hair) +
               Path(inner, "fill='#b07040' " + hair));
  };
  for (const std::string hair : {"stroke='none'", "stroke-width='.01'"}) {
    const Outcome<Sketch> read = ReadSvg(page("M2 2H198V98H2Z", hair));
    ASSERT_EQ(CountOf(read, "ink-outlines"), 1) << hair;
    ASSERT_EQ(read->strokes.size(), 1u);
    const Stroke& outline = read->strokes[0];
    EXPECT_TRUE(outline.closed);
    EXPECT_NEAR(outline.width, 2, 0.3);
    const Eigen::AlignedBox2d box = Bounds(*read);
    EXPECT_NEAR((box.min() - Vector2d(1, 1)).norm() + (box.max() - Vector2d(199, 99)).norm(), 0,
                0.3);
  }
  // A spot on a black body, and a body with a black foot.
  EXPECT_EQ(CountOf(ReadSvg(page("M50 20H150V80H50Z", "stroke='none'")), "ink-outlines"), 0);
  EXPECT_EQ(CountOf(ReadSvg(page("M0 0H200V95H0Z", "stroke='none'")), "ink-outlines"), 0);
}

TEST(InkOutlines, SilhouettesAreAreas) {
  const std::string horse = Polygon(PointsOf(Example("horse").strokes.front(), 0.1));
  const std::string body = "M0 0H200V20H140V100H120V40H40V100H20V40H0Z";
  for (const std::string& d : {horse, body, body + "M30 10V20H60V10Z",  // a hole
                               std::string("M0 0H200V3H0Z"), std::string("M0 0H100V100")}) {
    const Outcome<Sketch> read = ReadSvg(Svg(Path(d, kBlack)));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(CountOf(read, "ink-outlines"), 0) << d;
    EXPECT_EQ(read->strokes.size(), std::size_t(std::count(d.begin(), d.end(), 'M'))) << d;
  }
}

TEST(InkOutlines, EyesAreDotsAndFillsHaveOutlines) {
  const std::string ring = "M0 0H200V100H0Z M2 2V98H198V2Z ";
  const Stroke eye = testing::Circle({30, 30}, 2), patch = testing::Circle({120, 50}, 25);
  const Outcome<Sketch> read =
      ReadSvg(Svg(Path(ring + Polygon(PointsOf(eye, 0.01)) + Polygon(PointsOf(patch, 0.01)),
                       kBlack + "fill-rule='evenodd'")));
  ASSERT_EQ(CountOf(read, "ink-outlines"), 1);
  ASSERT_EQ(read->strokes.size(), 3u);
  int dots = 0, rings = 0;
  for (const Stroke& stroke : read->strokes) {
    dots += stroke.is_dot && (stroke.pieces[0].p[0] - Vector2d(30, 30)).norm() < 0.5;
    rings += stroke.closed;
  }
  EXPECT_EQ(dots, 1);
  EXPECT_EQ(rings, 2);
}

TEST(InkOutlines, PensAreTheDrawingWhereTheyReachAroundIt) {
  const std::string ring = Path("M0 0H200V100H0Z M2 2V98H198V2Z", kBlack);
  EXPECT_EQ(CountOf(ReadSvg(Svg(ring)), "ink-outlines"), 1);
  EXPECT_EQ(CountOf(ReadSvg(Svg(ring + Path("M1 1H199V99H1Z"))), "ink-outlines"), 0);
  // Lines inside stay lines.
  const Outcome<Sketch> read = ReadSvg(Svg(ring + Path("M50 50H60")));
  EXPECT_EQ(CountOf(read, "ink-outlines"), 1);
  EXPECT_EQ(read->strokes.size(), 2u);
}

TEST(InkOutlines, ExtremePagesAreReadLikeOthers) {
  const auto ring = [](const std::string& unit) {
    return Svg("<g transform='scale(" + unit + ")'>" +
               Path("M0 0H200V100H0Z M2 2V98H198V2Z", kBlack) + "</g>");
  };
  for (const char* unit : {"1e-60", "1e-6", "1e6", "1e60"}) {
    const Outcome<Sketch> read = ReadSvg(ring(unit));
    EXPECT_EQ(testing::WrongWith(read), "") << unit;
    EXPECT_EQ(CountOf(read, "ink-outlines"), 1) << unit;
  }
  // A thousand pages of colour on one another, and areas of no height.
  std::string layers;
  for (int i = 0; i < 1000; ++i) layers += Path("M2 2V98H198V2Z", "stroke='none' fill='red'");
  EXPECT_EQ(CountOf(ReadSvg(Svg(Path("M0 0H200V100H0Z", kBlack) + layers)), "ink-outlines"), 0);
  EXPECT_EQ(CountOf(ReadSvg(Svg(Path("M0 0H200Z", kBlack))), "ink-outlines"), 0);
}

}  // namespace
}  // namespace lascaux

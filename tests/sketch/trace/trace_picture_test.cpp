#include "lascaux/sketch/trace_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "lascaux/sketch/read_svg.h"
#include "sketch/drawings.h"
#include "sketch/trace/pen.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::Blocky;
using testing::Blurry;
using testing::Circle;
using testing::Farthest;
using testing::ForSeeds;
using testing::Grainy;
using testing::Page;
using testing::Placed;
using testing::Random;
using testing::Straight;
using testing::Unevenly;

Stroke Penned(Stroke stroke, double width) {
  stroke.width = width;
  return stroke;
}

Sketch Traced(const Bitmap& picture) {
  const auto traced = TracePicture(picture);
  EXPECT_TRUE(traced.ok());
  return traced.ok() ? traced->sketch : Sketch{};
}

Stroke PointAt(const Vector2d& p) {
  Stroke stroke;
  stroke.pieces.push_back({{p, p, p, p}});
  return stroke;
}

Sketch SketchOf(const Stroke& stroke) { return {{stroke}}; }

/// Both ways, in widths of the pen.
double Distance(const Sketch& a, const Sketch& b, double width) {
  return std::max(Farthest(a, b), Farthest(b, a)) / width;
}

Sketch Example(const std::string& name, const Vector2d& page, double width) {
  std::ifstream in(std::filesystem::path(LASCAUX_EXAMPLES) / (name + ".svg"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return Placed(*ReadSvg(bytes), page, width);
}

std::string FirstError(const Bitmap& picture, const TracePictureOptions& options = {}) {
  const auto traced = TracePicture(picture, options);
  return traced.ok() ? "" : traced.diagnostics().front().code;
}

TEST(TracePicture, LineIsTheMiddleOfItsInk) {
  ForSeeds(20, [](Random& random) {
    const double width = random.Uniform(4, 12), angle = random.Uniform(0, std::numbers::pi);
    const Vector2d middle(150 + random.Uniform(0, 1), 150 + random.Uniform(0, 1));
    const Vector2d along(std::cos(angle), std::sin(angle));
    const Stroke line = Penned(Straight({middle - 100 * along, middle + 100 * along}), width);
    Page page(300, 300);
    page.Draw(line);
    const Sketch traced = Traced(page.Seen());
    ASSERT_EQ(traced.strokes.size(), 1u);
    EXPECT_LT(Distance(traced, SketchOf(line), width), 0.15);
    EXPECT_NEAR(traced.strokes[0].width, width, 0.5);
    EXPECT_FALSE(traced.strokes[0].closed);
  });
}

TEST(TracePicture, CircleIsOneClosedSmoothStroke) {
  for (const double radius : {12.0, 30.0, 80.0}) {
    const Stroke circle = Penned(Circle({100.3, 99.6}, radius), 6);
    Page page(200, 200);
    page.Draw(circle);
    const Sketch traced = Traced(page.Seen());
    ASSERT_EQ(traced.strokes.size(), 1u) << radius;
    const Stroke& stroke = traced.strokes[0];
    EXPECT_TRUE(stroke.closed);
    EXPECT_LT(Distance(traced, SketchOf(circle), 6), 0.1) << radius;
    for (std::size_t i = 0; i < stroke.pieces.size(); ++i) {
      const auto& next = stroke.pieces[(i + 1) % stroke.pieces.size()];
      EXPECT_GT(stroke.pieces[i].EndTangent().dot(next.StartTangent()), 0.95) << radius;
    }
  }
}

TEST(TracePicture, TeeHasABarAndAStemThatEndsOnIt) {
  ForSeeds(20, [](Random& random) {
    const double lean = random.Uniform(-0.9, 0.9), width = random.Uniform(4, 9);
    const Stroke bar = Penned(Straight({{40, 150}, {260, 150}}), width);
    const Vector2d foot(150, 150), end = foot + 100 * Vector2d(std::sin(lean), std::cos(lean));
    const Stroke stem = Penned(Straight({foot, end}), width);
    Page page(300, 300);
    page.Draw(bar);
    page.Draw(stem);
    const Sketch traced = Traced(page.Seen());
    ASSERT_EQ(traced.strokes.size(), 2u);
    const bool first = Farthest(SketchOf(traced.strokes[0]), SketchOf(bar)) < width;
    const Sketch found_bar = SketchOf(traced.strokes[first ? 0 : 1]);
    const Stroke& found = traced.strokes[first ? 1 : 0];
    EXPECT_LT(Distance(found_bar, SketchOf(bar), width), 0.2);
    EXPECT_LT(Distance(SketchOf(found), SketchOf(stem), width), 0.5);
    const Vector2d ends[] = {found.pieces.front().p[0], found.pieces.back().p[3]};
    double gap = 1e9;
    for (const Vector2d& p : ends) gap = std::min(gap, Farthest(SketchOf(PointAt(p)), found_bar));
    EXPECT_LT(gap, 0.06);  // as exact as Farthest() flattens
  });
}

TEST(TracePicture, CrossingLinesStayTwo) {
  for (const double angle : {0.6, 1.0, std::numbers::pi / 2}) {
    const Vector2d a(std::cos(angle / 2), std::sin(angle / 2)), b(a.x(), -a.y()), c(150.2, 149.7);
    const Sketch lines{{Penned(Straight({c - 100 * a, c + 100 * a}), 6),
                        Penned(Straight({c - 100 * b, c + 100 * b}), 6)}};
    Page page(300, 300);
    page.Draw(lines);
    const Sketch traced = Traced(page.Seen());
    EXPECT_EQ(traced.strokes.size(), 2u) << angle;
    EXPECT_LT(Distance(traced, lines, 6), 0.25) << angle;
  }
}

TEST(TracePicture, CornerIsWhereItsSidesMeet) {
  for (const double degrees : {30.0, 45.0, 70.0, 90.0, 120.0}) {
    const double half = degrees * std::numbers::pi / 360;
    const Vector2d tip(150.4, 60.2);
    const Vector2d left = tip + 150 * Vector2d(-std::sin(half), std::cos(half));
    const Vector2d right = tip + 150 * Vector2d(std::sin(half), std::cos(half));
    const Stroke corner = Penned(Straight({left, tip, right}), 6);
    Page page(300, 300);
    page.Draw(corner);
    const Sketch traced = Traced(page.Seen());
    ASSERT_EQ(traced.strokes.size(), 1u) << degrees;
    EXPECT_LT(Distance(traced, SketchOf(corner), 6), 0.4) << degrees;
  }
}

TEST(TracePicture, WhatCamerasDoMovesNoLine) {
  // Widths: the ink of a line that ends beside another one does not tell its end.
  constexpr double kOverlap = 1.25;
  const double width = 7;
  for (const char* name : {"cat", "elephant", "giraffe"}) {
    const Sketch drawn = Example(name, {760, 620}, width);
    Page page(760, 620);
    page.Draw(drawn);
    const Bitmap clean = page.Seen();
    const auto best = TracePicture(clean);
    ASSERT_TRUE(best.ok()) << name;
    EXPECT_GE(best->facts.coverage, 0.99) << name;
    EXPECT_EQ(best->facts.curve_regions, best->facts.ink_regions) << name;
    Random random(7);
    const Bitmap bad[] = {Unevenly(clean), Grainy(Blurry(Unevenly(clean), 1), 6, random),
                          Blocky(Blurry(clean, 1), 24), Unevenly(page.Seen(0.6))};
    EXPECT_LT(Distance(best->sketch, drawn, width), kOverlap) << name;
    for (const Bitmap& picture : bad) {
      const auto traced = TracePicture(picture);
      ASSERT_TRUE(traced.ok()) << name;
      EXPECT_LT(Distance(traced->sketch, drawn, width), kOverlap) << name;
      EXPECT_EQ(traced->facts.curve_regions, best->facts.ink_regions) << name;
    }
  }
}

TEST(TracePicture, FlatColoursUnderTheLinesAreNoInk) {
  const Stroke circle = Penned(Circle({150, 150}, 100), 6);
  Page page(300, 300);
  page.Paint({150, 150}, 100, {0.1, 0.6, 0.25});
  page.Paint({190, 120}, 40, {0.75, 0.3, 0.2});
  page.Draw(circle);
  const Sketch traced = Traced(page.Seen(0.02));
  ASSERT_EQ(traced.strokes.size(), 1u);
  EXPECT_LT(Distance(traced, SketchOf(circle), 6), 0.15);
}

TEST(TracePicture, FilledAreaIsItsOutline) {
  const Stroke outline = Penned(Circle({150, 150}, 120), 5);
  Page page(300, 300);
  page.Draw(outline);
  page.Blot({150, 150}, 22.5);
  const Sketch traced = Traced(page.Seen());
  ASSERT_EQ(traced.strokes.size(), 2u);
  Sketch both{{outline, Penned(Circle({150, 150}, 20), 5)}};
  EXPECT_LT(Distance(traced, both, 5), 0.25);
  EXPECT_TRUE(traced.strokes[0].closed && traced.strokes[1].closed);
}

TEST(TracePicture, SmallBlotIsADot) {
  Page page(200, 200);
  page.Draw(Penned(Circle({100, 100}, 80), 6));
  page.Blot({130, 80}, 4);
  const Sketch traced = Traced(page.Seen());
  ASSERT_EQ(traced.strokes.size(), 2u);
  const Stroke& dot = traced.strokes[traced.strokes[0].is_dot ? 0 : 1];
  ASSERT_TRUE(dot.is_dot);
  EXPECT_LT((dot.pieces[0].p[0] - Vector2d(130, 80)).norm(), 1);
  EXPECT_NEAR(dot.width, 8, 1.6);
}

TEST(TracePicture, ChalkOnABoardAndInkOnNothingAreInk) {
  const Stroke circle = Penned(Circle({100, 100}, 70), 6);
  Page page(200, 200);
  page.Draw(circle);
  Bitmap chalk = page.Seen(0), film = chalk;
  for (std::size_t i = 0; i < chalk.rgba.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c) {
      chalk.rgba[i + c] = static_cast<std::uint8_t>(255 - chalk.rgba[i + c]);
      film.rgba[i + 3] = static_cast<std::uint8_t>(std::lround(255 * page.ink[i / 4]));
      film.rgba[i + c] = 0;
    }
  for (const Bitmap& picture : {chalk, film})
    EXPECT_LT(Distance(Traced(picture), SketchOf(circle), 6), 0.15);
}

TEST(TracePicture, SizeOfThePictureDoesNotMatter) {
  for (const double scale : {0.4, 1.0, 6.0}) {  // pens 2.4, 6 and 36 pixels wide
    const int side = static_cast<int>(400 * scale);
    const double width = 6 * scale;
    const Sketch drawn = Example("cat", {400 * scale, 400 * scale}, width);
    Page page(side, side);
    page.Draw(drawn);
    const auto traced = TracePicture(page.Seen());
    ASSERT_TRUE(traced.ok()) << scale;
    EXPECT_LT(Distance(traced->sketch, drawn, width), 1.0) << scale;
    EXPECT_NEAR(traced->facts.ink_width, width, 0.2 * width + 0.5) << scale;
  }
}

TEST(TracePicture, PagesWithoutInkAreEmpty) {
  Random random(3);
  const Bitmap blank = Page(300, 200).Seen();
  for (const Bitmap& page :
       {blank, Unevenly(blank), Grainy(Unevenly(blank), 4, random), Page(3, 3).Seen()})
    EXPECT_EQ(FirstError(page), "empty-page");
}

TEST(TracePicture, TexturesAreNoDrawing) {
  // Noise of many sizes, as foliage and fur have it.
  Random random(5);
  const int side = 512;
  std::vector<double> sum(static_cast<std::size_t>(side * side));
  for (int cell = 2; cell <= 64; cell *= 2) {
    std::vector<double> grid;
    const int n = side / cell + 2;
    for (int i = 0; i < n * n; ++i) grid.push_back(random.Uniform(-1, 1));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        sum[static_cast<std::size_t>(y * side + x)] +=
            std::sqrt(cell) * grid[static_cast<std::size_t>(y / cell * n + x / cell)];
  }
  Bitmap picture{side, side, {}};
  for (const double v : sum) {
    const auto level = static_cast<std::uint8_t>(std::clamp(128 + 10 * v, 0.0, 255.0));
    picture.rgba.insert(picture.rgba.end(), {level, level, level, 255});
  }
  EXPECT_EQ(FirstError(picture), "no-drawing");
}

TEST(TracePicture, TooManyPixelsAreRefused) {
  EXPECT_EQ(FirstError(Page(300, 200).Seen(), {.max_pixels = 59'999}), "too-large");
}

}  // namespace
}  // namespace lascaux

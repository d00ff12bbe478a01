#include <gtest/gtest.h>

#include <string>

#include "sketch/svg_text.h"

namespace lascaux {
namespace {

using testing::CountOf;
using testing::EndsOf;
using testing::Path;
using testing::Strokes;
using testing::Svg;

/// Lines that reach around everything, so that they are the drawing.
const std::string kFrame = Path("M-9 -9H19V19H-9Z"), kFrameEnds = "-9,-9 19,-9 19,19 -9,19 -9,-9; ";
const std::string kLine = Path("M0 5H10");
const std::string kArea = "M4 0H6V10H4Z";

std::string Area(const std::string& attributes) {
  return Path(kArea, "stroke='none' " + attributes);
}

TEST(SvgPage, LaterAreasHideTheLinesUnderThem) {
  for (const char* fill : {"fill='white'", "fill='red'", "fill='url(#unknown)'"}) {
    const Outcome<Sketch> outcome = ReadSvg(Svg(kFrame + kLine + Area(fill)));
    ASSERT_TRUE(outcome.ok());
    EXPECT_EQ(CountOf(outcome, "hidden-line"), 1) << fill;
    ASSERT_EQ(outcome->strokes.size(), 3u) << fill;
    // Less half a pen at both sides, which still shows.
    EXPECT_NEAR(outcome->strokes[1].pieces.back().p[3].x(), 4.5, 0.01);
    EXPECT_NEAR(outcome->strokes[2].pieces.front().p[0].x(), 5.5, 0.01);
  }
}

TEST(SvgPage, WhatDoesNotCoverHidesNothing) {
  for (const std::string& other :
       {Area("fill='red' fill-opacity='.5'"), Area("fill='red' opacity='.5'"),
        Area("fill='red' clip-path='url(#c)'"), Area("fill='none'"),
        "<g mask='url(#m)'>" + Area("fill='red'") + "</g>"}) {
    EXPECT_EQ(EndsOf(Svg(kFrame + kLine + other)), kFrameEnds + "0,5 10,5") << other;
  }
  // What was drawn before, and the area of the line itself.
  EXPECT_EQ(EndsOf(Svg(kFrame + Area("fill='red'") + kLine)), kFrameEnds + "0,5 10,5");
  EXPECT_EQ(EndsOf(Svg(Path("M0 0H10V10Z", "fill='red'"))), "0,0 10,0 10,10 0,0");
  // A line along the outline of an area.
  EXPECT_EQ(EndsOf(Svg(Path("M0 0H10V10Z") + Path("M0 0H10V10Z", "fill='red' stroke='none'"))),
            "0,0 10,0 10,10 0,0");
}

TEST(SvgPage, HolesShowWhatIsUnderThem) {
  const std::string ring = "M2 0H8V10H2Z M4 2V8H6V2Z", same_way = "M2 0H8V10H2Z M4 2H6V8H4Z";
  const auto count = [](const std::string& d, const std::string& rule) {
    return Strokes(Svg(kFrame + Path("M0 5H10", "stroke-width='.01'") +
                       Path(d, "stroke='none' fill='red' " + rule)))
        .size();
  };
  EXPECT_EQ(count(ring, ""), 4u);
  EXPECT_EQ(count(same_way, ""), 3u);
  EXPECT_EQ(count(same_way, "fill-rule='evenodd'"), 4u);
  EXPECT_EQ(count(same_way, "style='fill-rule:evenodd'"), 4u);
}

TEST(SvgPage, AClosedLineThatIsHiddenElsewhereIsOneStretchAtItsBeginning) {
  const auto strokes = Strokes(Svg(Path("M0 0H10V10H0Z", "stroke-width='.01'") +
                                   Path("M9 4H11V6H9Z", "stroke='none' fill='white'")));
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_FALSE(strokes[0].closed);
  EXPECT_NEAR(strokes[0].pieces.front().p[0].y(), 6, 0.02);
  EXPECT_NEAR(strokes[0].pieces.back().p[3].y(), 4, 0.02);
}

TEST(SvgPage, AreasAreTheDrawingWhereLinesAreItsDetails) {
  const std::string body = Path("M0 0H100V50H0Z", "stroke='none' fill='green'");
  EXPECT_EQ(Strokes(Svg(body + Path("M40 10 60 20"))).size(), 2u);
  // Lines that reach around it are all there is.
  EXPECT_EQ(EndsOf(Svg(body + Path("M1 1H99V49H1Z"))), "1,1 99,1 99,49 1,49 1,1");
}

TEST(SvgPage, AreasOfOneColorHaveNoEdgeBetweenThem) {
  const std::string areas = "<svg><path d='M0 0H10V10H0Z'/><path d='M4 5H6V20H4Z'/></svg>";
  const auto strokes = Strokes(areas);
  for (const Stroke& stroke : strokes) {
    for (const CubicBezier& piece : stroke.pieces) {
      const Eigen::Vector2d middle = piece.At(0.5);
      EXPECT_FALSE(middle.x() > 0.1 && middle.x() < 9.9 && middle.y() > 0.1 && middle.y() < 9.9);
    }
  }
  // Of another color it has.
  EXPECT_EQ(
      Strokes("<svg><path d='M0 0H10V10H0Z'/><path d='M4 5H6V9H4Z' fill='red'/></svg>").size(), 2u);
}

TEST(SvgPage, WhiteAreasAreSeenOnColorsOnly) {
  const std::string white = "<path d='M-5 -5H15V15H-5Z' fill='#fff'/>",
                    black = "<path d='M0 0H10V10H0Z'/>",
                    eye = "<path d='M2 2H4V4H2Z' fill='white'/>";
  EXPECT_EQ(EndsOf("<svg>" + white + black + "</svg>"), "0,0 10,0 10,10 0,10 0,0");
  EXPECT_EQ(Strokes("<svg>" + white + black + eye + "</svg>").size(), 2u);
  // A drawing of nothing else is not empty.
  EXPECT_EQ(Strokes("<svg>" + white + "</svg>").size(), 1u);
}

TEST(SvgPage, SmallDarkBlobsAreEyes) {
  const std::string outline = Path("M0 0H100V100H0Z");
  const auto with = [&](const std::string& circle) {
    return Strokes(Svg(outline + "<circle stroke='none' cx='20' cy='20' " + circle + "/>")).size();
  };
  EXPECT_EQ(with("r='3' fill='#222'"), 2u);
  EXPECT_EQ(with("r='3' fill='pink'"), 1u);    // a cheek
  EXPECT_EQ(with("r='20' fill='#222'"), 1u);   // a patch
  EXPECT_EQ(with("r='0.1' fill='#222'"), 1u);  // a speck
}

}  // namespace
}  // namespace lascaux

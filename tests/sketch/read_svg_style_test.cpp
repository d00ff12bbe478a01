#include <gtest/gtest.h>

#include "sketch/svg_text.h"

namespace lascaux {
namespace {

using testing::EndsOf;
using testing::Path;
using testing::Strokes;
using testing::Svg;

constexpr Color kRed{1, 0, 0}, kBlack{0, 0, 0};

/// The colour of the line that is drawn by a path with these attributes, after this style sheet.
std::optional<Color> LineColor(const std::string& attributes, const std::string& css = "") {
  const auto strokes = Strokes(Svg("<style>" + css + "</style>" + Path("M0 0 1 1", attributes)));
  return strokes.empty() ? std::nullopt : strokes[0].stroke_color;
}

TEST(SvgStyle, ColorsAreReadInAllTheirNotations) {
  for (const char* text :
       {"red", "#f00", "#FF0000", "rgb(255,0,0)", "rgb( 100% , 0% , 0% )", "Red", "#f00f",
        "rgb(255 0 0 / 50%)", "rgba(255,0,0,.5)", "#ff0000 icc-color(x, 1)", "url(#missing) red"}) {
    EXPECT_EQ(LineColor("stroke='" + std::string(text) + "'"), kRed) << text;
  }
  EXPECT_EQ(LineColor("stroke='lightgoldenrodyellow'"),
            (Color{250 / 255., 250 / 255., 210 / 255.}));
  EXPECT_EQ(LineColor("stroke='aliceblue'"), (Color{240 / 255., 248 / 255., 1}));
  EXPECT_EQ(LineColor("stroke='yellowgreen'"), (Color{154 / 255., 205 / 255., 50 / 255.}));
}

TEST(SvgStyle, PaintsOfUnknownColorStillDraw) {
  EXPECT_EQ(LineColor("stroke='url(#g)'"), std::nullopt);
  EXPECT_EQ(LineColor("stroke='hsl(0 100% 50%)'"), std::nullopt);
}

TEST(SvgStyle, WhatIsNoPaintIsIgnored) {
  for (const char* text : {"reddish", "#12", "#ggg", "rgb(1,2)", "rgb(1,2,3", ""}) {
    EXPECT_EQ(LineColor("stroke='" + std::string(text) + "'"), kBlack) << text;
  }
}

TEST(SvgStyle, StrongerDeclarationsWin) {
  const std::string red = "stroke: red", blue = "stroke: blue";
  EXPECT_EQ(LineColor("stroke='blue'", "path {" + red + "}"), kRed);
  EXPECT_EQ(LineColor("class='a'", ".a {" + red + "} path {" + blue + "}"), kRed);
  EXPECT_EQ(LineColor("class='a' id='b'", "#b {" + red + "} .a {" + blue + "}"), kRed);
  EXPECT_EQ(LineColor("class='a'", ".a {" + blue + "} .a {" + red + "}"), kRed);
  EXPECT_EQ(LineColor("class='a'", "path.a {" + red + "} .a {" + blue + "}"), kRed);
  EXPECT_EQ(LineColor("style='" + red + "' id='b'", "#b {" + blue + "}"), kRed);
  EXPECT_EQ(LineColor("style='" + blue + "'", "* {" + red + " !important}"), kRed);
  EXPECT_EQ(LineColor("style='" + red + "!important'", "path {" + blue + " !important}"), kRed);
}

TEST(SvgStyle, SelectorsMatchNamesClassesIdsAndNesting) {
  const auto is_red = [](const std::string& selector) {
    const std::string css = "<style>" + selector + "{stroke:red}</style>";
    const std::string body =
        "<g class='outer'><g id='mid' class='m n'><path id='p' class='a b' "
        "d='M0 0 1 1'/></g></g>";
    return Strokes(Svg(css + body))[0].stroke_color == kRed;
  };
  for (const char* selector : {"path",
                               "*",
                               ".a",
                               ".b",
                               ".a.b",
                               "path.a",
                               "#p",
                               "path#p.a",
                               "g path",
                               "g &gt; path",
                               ".outer path",
                               ".outer .m path",
                               ".outer &gt; #mid &gt; path",
                               "svg g path",
                               "x, .a",
                               ".outer &gt; .m .a",
                               ".m",
                               "g&gt;.a",
                               "/* c */ .a /* d */",
                               "svg .outer path"}) {
    EXPECT_TRUE(is_red(selector)) << selector;
  }
  for (const char* selector :
       {"rect", ".ab", ".A", "#q", "path path", ".outer &gt; path", ".b.c", "svg &gt; path", "[d]",
        "path:hover", "g + path", "", "&gt; path", ".m &gt; .outer path", ".", "path &gt;"}) {
    EXPECT_FALSE(is_red(selector)) << selector;
  }
}

TEST(SvgStyle, AtRulesAreForOtherReadersUnlessTheyAreForScreens) {
  EXPECT_EQ(LineColor("", "@import url(x.css); path{stroke:red}"), kRed);
  EXPECT_EQ(LineColor("", "@font-face {src: url(data:a;b}{)} path{stroke:red}"), kRed);
  EXPECT_EQ(LineColor("", "@media print {path{stroke:blue}} path{stroke:red}"), kRed);
  EXPECT_EQ(LineColor("", "path{stroke:blue} @media screen {path{stroke:red}}"), kRed);
  EXPECT_EQ(LineColor("", "<![CDATA[path > x{} path{stroke:red} /* ]]>"), kRed);
  EXPECT_EQ(LineColor("", "path{stroke:red"), kRed);
}

TEST(SvgStyle, LinesInheritFromGroups) {
  const std::string body = "<g stroke='red' stroke-width='3'>" + Path("M0 0 1 1") +
                           Path("M0 0 2 2", "stroke='none'") + "<g stroke='none'>" +
                           Path("M0 0 3 3") + Path("M0 0 4 4", "stroke='inherit'") +
                           Path("M0 0 5 5", "style='stroke:initial'") + "</g></g>";
  const auto strokes = Strokes(Svg(body));
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_EQ(strokes[0].width, 3);
  EXPECT_EQ(strokes[0].stroke_color, kRed);
}

TEST(SvgStyle, CurrentColorIsTheColorWhereItIsUsed) {
  const auto strokes = Strokes("<svg stroke='currentColor' fill='none'><g color='red'>" +
                               Path("M0 0 1 1") + "</g>" + Path("M0 0 2 1") + "</svg>");
  EXPECT_EQ(strokes[0].stroke_color, kRed);
  EXPECT_EQ(strokes[1].stroke_color, kBlack);
}

TEST(SvgStyle, WhatCantBeSeenIsNoStroke) {
  const std::string seen = Path("M0 0 1 1");
  for (const char* attributes :
       {"display='none'", "visibility='hidden'", "visibility='collapse'", "opacity='0'",
        "stroke-opacity='0%'", "stroke-width='0'", "stroke='none'", "stroke='transparent'",
        "stroke='#1230'", "stroke='rgba(9,9,9,0)'", "style='display:none'",
        "transform='scale(0)'"}) {
    EXPECT_EQ(EndsOf(Svg(seen + Path("M5 5 6 6", attributes))), "0,0 1,1") << attributes;
    EXPECT_EQ(EndsOf(Svg(seen + "<g " + attributes + ">" + Path("M5 5 6 6") + "</g>")), "0,0 1,1")
        << attributes;
  }
}

TEST(SvgStyle, AVisiblePathInAHiddenGroupIsSeenButNoneInAGroupThatIsNotDisplayed) {
  const std::string path = Path("M0 0 1 1", "visibility='visible' display='inline'");
  EXPECT_EQ(EndsOf(Svg("<g visibility='hidden'>" + path + "</g>" + Path("M0 0 2 2"))),
            "0,0 1,1; 0,0 2,2");
  EXPECT_EQ(EndsOf(Svg("<g display='none'>" + path + "</g>" + Path("M0 0 2 2"))), "0,0 2,2");
}

TEST(SvgStyle, PenWidthsHaveUnitsAndGrowWithTheTransform) {
  const auto width = [](const std::string& attributes) {
    return Strokes(Svg(Path("M0 0 1 1", attributes), "viewBox='0 0 30 40'"))[0].width;
  };
  EXPECT_EQ(width(""), 1);
  EXPECT_EQ(width("stroke-width='2.5px'"), 2.5);
  EXPECT_DOUBLE_EQ(width("stroke-width='3pt'"), 4);
  EXPECT_DOUBLE_EQ(width("style='stroke-width: 10%'"), 5 / std::sqrt(2));
  EXPECT_DOUBLE_EQ(width("transform='scale(3)'"), 3);
  EXPECT_DOUBLE_EQ(width("transform='scale(2 8)' stroke-width='2'"), 8);
  EXPECT_EQ(width("stroke-width='-4'"), 1);
  EXPECT_EQ(width("stroke-width='4 apples'"), 1);
}

TEST(SvgStyle, AreasUnderLinesGiveThemTheirColor) {
  const auto strokes =
      Strokes("<svg>" + Path("M0 0 1 1 2 0", "stroke='blue' fill='red'") + "</svg>");
  EXPECT_EQ(strokes[0].fill_color, kRed);
  EXPECT_EQ(Strokes(Svg(Path("M0 0 1 1 2 0")))[0].fill_color, std::nullopt);
}

}  // namespace
}  // namespace lascaux

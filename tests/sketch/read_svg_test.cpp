#include "lascaux/sketch/read_svg.h"

#include <gtest/gtest.h>

#include "sketch/svg_text.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::CountOf;
using testing::EndsOf;
using testing::MessageOf;
using testing::Path;
using testing::Strokes;
using testing::Svg;
using testing::WrongWith;

/// The code of the error that reading gives, with its message if that says no place or no remedy.
std::string ErrorOf(const std::string& bytes, const ReadSvgOptions& options = {}) {
  const Outcome<Sketch> outcome = ReadSvg(bytes, options);
  EXPECT_EQ(WrongWith(outcome), "");
  if (outcome.ok()) return "no error";
  const Diagnostic& error = outcome.diagnostics().back();
  const bool has_place = error.message.find("line ") != std::string::npos ||
                         error.message.find("byte ") != std::string::npos;
  return has_place && error.message.find(';') != std::string::npos ? error.code : error.message;
}

TEST(SvgShapes, BeginAndRunAsTheStandardSays) {
  EXPECT_EQ(EndsOf(Svg("<line x1='1' y1='2' x2='3' y2='4'/>")), "1,2 3,4");
  EXPECT_EQ(EndsOf(Svg("<polyline points='0,0 1 1,2,0'/>")), "0,0 1,1 2,0");
  EXPECT_EQ(EndsOf(Svg("<polygon points='0,0 1 1,2,0'/>")), "0,0 1,1 2,0 0,0");
  EXPECT_EQ(EndsOf(Svg("<rect x='1' y='2' width='10' height='5'/>")), "1,2 11,2 11,7 1,7 1,2");
  const auto circle = Strokes(Svg("<circle cx='5' cy='6' r='2'/>"));
  EXPECT_EQ(circle[0].pieces.size(), 8u);
  EXPECT_TRUE(circle[0].closed);
  EXPECT_EQ(circle[0].pieces[0].p[0], Vector2d(7, 6));
  EXPECT_GT(circle[0].pieces[0].p[3].y(), 6);
  for (const CubicBezier& piece : circle[0].pieces) {
    EXPECT_NEAR((piece.At(0.5) - Vector2d(5, 6)).norm(), 2, 1e-5);
  }
  const Sketch ellipse{Strokes(Svg("<ellipse cx='5' cy='6' rx='3' ry='1'/>"))};
  EXPECT_LT((Bounds(ellipse).min() - Vector2d(2, 5)).norm(), 1e-12);
  EXPECT_LT((Bounds(ellipse).max() - Vector2d(8, 7)).norm(), 1e-12);
}

TEST(SvgShapes, RectanglesHaveRoundCornersThatFit) {
  const std::string rect = "<rect width='10' height='6' ";
  const auto both = Strokes(Svg(rect + "rx='2' ry='1'/>"));
  EXPECT_EQ(both[0].pieces.size(), 12u);
  EXPECT_EQ(both[0].pieces[0].p[0], Vector2d(2, 0));
  EXPECT_EQ(EndsOf(Svg(rect + "rx='2'/>")), EndsOf(Svg(rect + "rx='2' ry='2'/>")));
  EXPECT_EQ(EndsOf(Svg(rect + "ry='2'/>")), EndsOf(Svg(rect + "rx='2' ry='2'/>")));
  // Corners that use up all sides leave an ellipse without lines, and without pieces of no length.
  const Outcome<Sketch> lens = ReadSvg(Svg(rect + "rx='99' ry='99'/>"));
  ASSERT_TRUE(lens.ok());
  EXPECT_EQ(lens->strokes[0].pieces.size(), 8u);
  EXPECT_TRUE(lens.diagnostics().empty());
  EXPECT_EQ(Strokes(Svg(rect + "rx='0' ry='3'/>"))[0].pieces.size(), 4u);
}

TEST(SvgShapes, LengthsHaveUnits) {
  const std::string line =
      "<line x2='1in' y2='72pt'/><line x2='2.54cm' y2='25.4mm'/>"
      "<line x2='6pc' y2='101.6Q'/><line x2='6em' y2='12ex'/>";
  for (const Stroke& stroke : Strokes(Svg(line))) {
    EXPECT_LT((stroke.pieces[0].p[3] - Vector2d(96, 96)).norm(), 1e-12);
  }
  EXPECT_EQ(EndsOf(Svg("<line x1='50%' x2='100%' y2='10%'/>", "viewBox='-5 0 30 40'")),
            "15,0 30,4");
}

TEST(SvgFrame, IsThatOfTheRootsViewBoxWithoutItsSize) {
  const std::string path = Path("M100 200 150 240");
  EXPECT_EQ(EndsOf(Svg(path, "viewBox='100 200 50 40' width='10cm' height='5in' x='7' y='8'")),
            "100,200 150,240");
  EXPECT_EQ(EndsOf(Svg(path, "width='10cm'")), "100,200 150,240");
  EXPECT_EQ(EndsOf(Svg("<line x2='50%' y2='50%'/>", "width='1in' height='50px'")), "0,0 48,25");
}

TEST(SvgFrame, TransformsNest) {
  const auto ends = [](const std::string& transform) {
    return EndsOf(Svg(Path("M1 0 0 2", "transform='" + transform + "'")));
  };
  EXPECT_EQ(ends("translate(10)"), "11,0 10,2");
  EXPECT_EQ(ends("translate(10 20)"), "11,20 10,22");
  EXPECT_EQ(ends("scale(2)"), "2,0 0,4");
  EXPECT_EQ(ends("scale(-2,3)"), "-2,0 0,6");
  EXPECT_EQ(ends("rotate(90)"), "0,1 -2,0");
  EXPECT_EQ(ends("rotate(-90 1 1)"), "0,1 2,2");
  EXPECT_EQ(ends("rotate(30)rotate(60)"), "0,1 -2,0");
  EXPECT_EQ(ends("skewX(45)"), "1,0 2,2");
  EXPECT_EQ(ends("skewY(45)"), "1,1 0,2");
  EXPECT_EQ(ends("matrix(1 2 3 4 5 6)"), "6,8 11,14");
  EXPECT_EQ(ends(" translate( 10 , 20 ) , scale(2)"), "12,20 10,24");
  EXPECT_EQ(EndsOf(Svg("<g transform='translate(5)'><g transform='scale(2)'>" +
                       Path("M1 1 2 2", "style='transform: translate(1px, 0)'") + "</g></g>")),
            "9,2 11,4");
}

TEST(SvgFrame, NestedViewportsFitTheirViewBoxes) {
  const auto ends = [](const std::string& attributes) {
    return EndsOf(Svg("<svg x='10' y='20' width='20' height='10' viewBox='1 1 2 2' " + attributes +
                      ">" + Path("M1 1 3 3") + "</svg>"));
  };
  EXPECT_EQ(ends(""), "15,20 25,30");
  EXPECT_EQ(ends("preserveAspectRatio='xMinYMin'"), "10,20 20,30");
  EXPECT_EQ(ends("preserveAspectRatio='xMaxYMid meet'"), "20,20 30,30");
  EXPECT_EQ(ends("preserveAspectRatio='xMidYMid slice'"), "10,15 30,35");
  EXPECT_EQ(ends("preserveAspectRatio='xMidYMax slice'"), "10,10 30,30");
  EXPECT_EQ(ends("preserveAspectRatio='none'"), "10,20 30,30");
  EXPECT_EQ(EndsOf(Svg("<svg x='5' y='6'>" + Path("M0 0 1 1") + "</svg>")), "5,6 6,7");
}

TEST(SvgUse, DrawsItsTargetAgainSomewhereElse) {
  const std::string defs = "<defs>" + Path("M0 0 1 1", "id='p' stroke='inherit'") +
                           "<symbol id='s' viewBox='0 0 2 2'>" + Path("M0 0 2 2") +
                           "</symbol></defs>";
  EXPECT_EQ(EndsOf(Svg(defs + "<use href='#p' x='3' y='4' transform='scale(2)'/>")), "6,8 8,10");
  EXPECT_EQ(EndsOf(Svg(defs + "<use xlink:href='#p'/>")), "0,0 1,1");
  EXPECT_EQ(EndsOf(Svg(defs + "<use href='#s' x='1' width='4' height='4'/>")), "1,0 5,4");
  const auto red = Strokes(Svg(defs + "<use id='u' href='#s' stroke='red'/>", "viewBox='0 0 4 4'"));
  EXPECT_EQ(red[0].stroke_color, (Color{1, 0, 0}));
  EXPECT_EQ(red[0].svg_id, "u");
}

TEST(SvgUse, CyclesAndMissingTargetsAreReportedAndIgnored) {
  const Outcome<Sketch> cycle =
      ReadSvg(Svg("<g id='a'>" + Path("M0 0 1 1") + "<use href='#a'/><use href='#b'/></g>" +
                  "<g id='b'><use href='#c'/></g><g id='c'><use href='#b'/></g>"));
  ASSERT_TRUE(cycle.ok());
  EXPECT_EQ(cycle->strokes.size(), 1u);
  EXPECT_GE(CountOf(cycle, "bad-reference"), 3);
  const Outcome<Sketch> missing =
      ReadSvg(Svg("<use href='#no'/><use href='a.svg#b'/><use/>" + Path("M0 0 1 1")));
  EXPECT_EQ(CountOf(missing, "bad-reference"), 3);
  EXPECT_NE(MessageOf(missing, "bad-reference").find("'#no'"), std::string::npos);
}

TEST(SvgElements, OnlyWhatIsDrawnIsRead) {
  const std::string path = Path("M0 0 1 1"), other = Path("M5 5 6 6");
  for (const char* tag : {"defs", "symbol", "clipPath", "mask", "pattern", "marker", "metadata",
                          "linearGradient", "unknown", "x:g"}) {
    const std::string name = tag;
    EXPECT_EQ(EndsOf(Svg(path + "<" + name + ">" + other + "</" + name + ">")), "0,0 1,1") << tag;
  }
  EXPECT_EQ(EndsOf(Svg(path + "<a>" + other + "</a>")), "0,0 1,1; 5,5 6,6");
  EXPECT_EQ(EndsOf(Svg("<switch><foreignObject/><g requiredExtensions='x'>" + other + "</g><g>" +
                       path + "</g><g>" + other + "</g></switch>")),
            "0,0 1,1");
}

TEST(SvgElements, TextAndPicturesAreLeftOutWithANote) {
  const Outcome<Sketch> outcome =
      ReadSvg(Svg(Path("M0 0 1 1") + "<text>a</text><text>b</text><image/>"));
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(CountOf(outcome, "ignored-element"), 2);
}

TEST(SvgElements, PrefixesForTheSvgNamespaceAreUnderstood) {
  EXPECT_EQ(
      EndsOf("<s:svg xmlns:s='http://www.w3.org/2000/svg' xmlns:o='urn:o'><s:path stroke='red' "
             "d='M0 0 1 1'/><o:path stroke='red' d='M0 0 2 2'/></s:svg>"),
      "0,0 1,1");
}

TEST(SvgStrokes, WithoutAnyLineTheOutlinesOfAreasAreTaken) {
  const std::string areas =
      Path("M0 0H4V4", "id='a' fill='red'") + Path("M9 9 8 8", "fill='none'") + "<line x2='5'/>";
  const auto outlines = Strokes("<svg>" + areas + "</svg>");
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_EQ(testing::Ends(outlines[0]), "0,0 4,0 4,4 0,0");
  EXPECT_TRUE(outlines[0].closed);
  EXPECT_EQ(outlines[0].width, 0);
  EXPECT_EQ(outlines[0].fill_color, (Color{1, 0, 0}));
  EXPECT_EQ(EndsOf("<svg>" + areas + Path("M0 0 4 4", "stroke='red'") + "</svg>"), "0,0 4,4");
}

TEST(SvgStrokes, DuplicatesGoAndLeaveTheirColor) {
  const std::string shape = "M0 0C1 1 2 1 3 0L9 9";
  const std::string back = "M9 9L3 0C2 1 1 1 0 0";
  const Outcome<Sketch> outcome =
      ReadSvg(Svg(Path(shape, "fill='red' stroke='none'") + Path("M5 5 6 6") + Path(shape) +
                  Path(back) + Path("M0 0l3 0", "transform='scale(.1)'") + Path("M0 0h.3")));
  ASSERT_TRUE(outcome.ok());
  ASSERT_EQ(outcome->strokes.size(), 3u);
  // One note a curve, however many copies of it there are.
  EXPECT_EQ(CountOf(outcome, "duplicate-stroke"), 2);
  EXPECT_NE(MessageOf(outcome, "duplicate-stroke").find("and 1 more run along"), std::string::npos);
  EXPECT_EQ(outcome->strokes[1].fill_color, (Color{1, 0, 0}));
  for (const Diagnostic& d : outcome.diagnostics()) EXPECT_TRUE(d.stroke && d.at);
}

TEST(SvgStrokes, PiecesOfNoLengthGoWithANote) {
  const Outcome<Sketch> outcome = ReadSvg(Svg(Path("M0 0h0L1 1 1 1C1 1 1 1 1 1L2 0")));
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(testing::Ends(outcome->strokes[0]), "0,0 1,1 2,0");
  EXPECT_NE(MessageOf(outcome, "zero-length-piece").find("3 pieces"), std::string::npos);
  // A loop that comes back to its start has a length.
  EXPECT_EQ(Strokes(Svg(Path("M0 0C5 0 0 5 0 0")))[0].pieces.size(), 1u);
}

TEST(SvgStrokes, StrokesOfNoLengthWithRoundCapsAreDots) {
  const std::string round = "stroke-linecap='round' stroke-width='3'";
  const auto dots = Strokes(Svg(Path("M1 2h0M3 4zM5 6", round), "viewBox='0 0 9 9'"));
  ASSERT_EQ(dots.size(), 2u);
  EXPECT_TRUE(dots[0].is_dot && dots[1].is_dot);
  EXPECT_EQ(dots[0].pieces[0].p[2], Vector2d(1, 2));
  EXPECT_EQ(dots[1].pieces[0].p[0], Vector2d(3, 4));
  EXPECT_EQ(dots[0].width, 3);
  const Outcome<Sketch> butt = ReadSvg(Svg(Path("M1 2h0") + Path("M0 0 1 1")));
  EXPECT_EQ(butt->strokes.size(), 1u);
  EXPECT_EQ(CountOf(butt, "zero-length-piece"), 1);
}

TEST(SvgStrokes, RepeatedFindingsAreCounted) {
  std::string body;
  for (int i = 0; i < 50; ++i) body += Path("M0 0 1 1 x");
  const Outcome<Sketch> outcome = ReadSvg(Svg(body));
  EXPECT_EQ(CountOf(outcome, "bad-path-data"), 21);
  EXPECT_NE(outcome.diagnostics().back().message.find(" more "), std::string::npos);
}

TEST(SvgDocument, EntitiesOfItsOwnAreReplaced) {
  const std::string doctype =
      "<!DOCTYPE svg [<!-- <!ENTITY no 'x'> --><!ENTITY % p 'q'>\n"
      "<!ENTITY pen \"stroke:red\"><!ENTITY path '<path d=\"M0 0 1 1\" style=\"&pen;\"/>'>"
      "<!ENTITY quoted 'a\"b'><!ENTITY pen 'second'><!ENTITY ext SYSTEM 'file:///etc/passwd'>]>";
  const auto strokes =
      Strokes(doctype + Svg("&path;" + Path("M0 0 2 2", "id='&quoted;' style='&pen;'") +
                            "<!-- &path; --><title>&ext;&unknown;&amp;</title>"));
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_EQ(strokes[0].stroke_color, (Color{1, 0, 0}));
  EXPECT_EQ(strokes[1].svg_id, "a\"b");
  EXPECT_EQ(EndsOf("<!DOCTYPE svg [<!ENTITY a '&b;'><!ENTITY b '&a;'>]>" +
                   Svg(Path("M0 0 1 1") + "<title>&a;</title>")),
            "0,0 1,1");
}

TEST(SvgDocument, PlacesAreThoseOfTheFileBeforeItsEntitiesWereReplaced) {
  const Outcome<Sketch> outcome =
      ReadSvg("<!DOCTYPE svg [<!ENTITY long '12345678901234567890\n\n'>]>\n" +
              Svg("\n<title>&long;</title>\n  " + Path("M0 0 1 1 x")));
  EXPECT_NE(MessageOf(outcome, "bad-path-data").find("line 6, column 4"), std::string::npos)
      << MessageOf(outcome, "bad-path-data");
}

/// The bytes of a text of ASCII and Latin-1 characters (given as such) in wider units.
std::string Wide(std::string_view text, std::size_t unit, std::size_t at) {
  std::string bytes;
  for (const char c : text) {
    std::string one(unit, '\0');
    one[at] = c;
    bytes += one;
  }
  return bytes;
}

TEST(SvgDocument, EncodingsAreRecognised) {
  const std::string latin1 = Svg(Path("M0 0 1 1", "id='\xfc'"));
  const std::string utf8 = Svg(Path("M0 0 1 1", "id='\xc3\xbc'"));
  const std::pair<const char*, std::string> cases[] = {
      {"UTF-8", utf8},
      {"UTF-8 with mark", "\xef\xbb\xbf" + utf8},
      {"UTF-16LE with mark", "\xff\xfe" + Wide(latin1, 2, 0)},
      {"UTF-16BE with mark", "\xfe\xff" + Wide(latin1, 2, 1)},
      {"UTF-16LE", Wide(latin1, 2, 0)},
      {"UTF-16BE", Wide(latin1, 2, 1)},
      {"UTF-32LE", Wide(latin1, 4, 0)},
      {"UTF-32BE", Wide(latin1, 4, 3)},
      {"Latin-1", "<?xml version='1.0' encoding='ISO-8859-1'?>" + latin1},
      {"Latin-1 that doesn't say so", latin1},
  };
  for (const auto& [name, bytes] : cases) {
    const auto strokes = Strokes(bytes);
    ASSERT_EQ(strokes.size(), 1u) << name;
    EXPECT_EQ(strokes[0].svg_id, "\xc3\xbc") << name;
  }
}

TEST(SvgErrors, WhatIsNoSvg) {
  for (const char* bytes :
       {"", "   ", "hello", "<html><p></html>", "<svgs/>", "\x89PNG\r\n", "{\"a\": 1}"}) {
    EXPECT_EQ(ErrorOf(bytes), "not-svg") << bytes;
  }
}

TEST(SvgErrors, WhatIsBrokenXml) {
  EXPECT_EQ(ErrorOf("<svg><path d='M0 0"), "broken-xml");
  EXPECT_EQ(ErrorOf("<svg><g></svg>"), "broken-xml");
  EXPECT_EQ(ErrorOf("<?xml version='1.0'"), "broken-xml");
  EXPECT_EQ(ErrorOf("<!-- nothing else -->"), "broken-xml");
  EXPECT_EQ(ErrorOf("\x1f\x8b\x08"), "broken-xml");  // a compressed file that is cut off
  EXPECT_EQ(ErrorOf(std::string("<svg>\0</svg>", 12)), "broken-xml");
  const Outcome<Sketch> outcome = ReadSvg("<svg>\n<g>\n<path d='M0 0");
  EXPECT_NE(MessageOf(outcome, "broken-xml").find("line 3"), std::string::npos);
}

TEST(SvgErrors, WhatDrawsNothing) {
  EXPECT_EQ(ErrorOf("<svg/>"), "no-strokes");
  EXPECT_EQ(ErrorOf(Svg("<text>words</text>")), "no-strokes");
  EXPECT_EQ(ErrorOf(Svg(Path("M0 0") + Path("") + Path("M1 1h0"))), "no-strokes");
  EXPECT_EQ(ErrorOf("<svg display='none'>" + Path("M0 0 1 1", "stroke='red'") + "</svg>"),
            "no-strokes");
  EXPECT_EQ(ErrorOf(Svg("<rect width='-1' height='2'/><circle/><ellipse rx='1' ry='0'/>")),
            "no-strokes");
}

TEST(SvgErrors, WhatIsNotFinite) {
  for (const char* d : {"M0 0 1e999 1", "M NaN 0", "M0 0L1 1 nan 2", "M0 0 -inf 3", "M0 0 1e80 1",
                        "M0 0L1e308 0l1e308 0", "M0 0A1e-320 1e300 0 0 1 1 1", "M0 0 1e-90 1e-90",
                        "M0 0h10000000000e300"}) {
    EXPECT_EQ(ErrorOf(Svg(Path(d))), "not-finite") << d;
  }
  const std::string path = Path("M0 0 1e30 1");
  EXPECT_EQ(ErrorOf(Svg("<g transform='scale(1e60)'>" + path + "</g>")), "not-finite");
  EXPECT_EQ(ErrorOf(Svg("<g transform='scale(1e999)'>" + path + "</g>")), "not-finite");
  EXPECT_EQ(ErrorOf(Svg("<circle r='NaN'/>")), "not-finite");
  EXPECT_EQ(ErrorOf(Svg("<polyline points='0,0 1,inf'/>")), "not-finite");
  EXPECT_EQ(ErrorOf(Svg(Path("M0 0 1 1", "stroke-width='1e300'"))), "not-finite");
}

TEST(SvgErrors, WhatIsTooLarge) {
  EXPECT_EQ(ErrorOf(Svg(Path("M0 0 1 1")), {.max_bytes = 20}), "too-large");
  EXPECT_EQ(ErrorOf(Svg(Path("M0 0 1 1 2 2")), {.max_pieces = 1}), "too-large");
  EXPECT_EQ(ErrorOf(Svg(Path("M0 0zM1 1zM2 2z", "stroke-linecap='round'")), {.max_pieces = 2}),
            "too-large");
  EXPECT_EQ(ErrorOf(Svg("<rect width='1' height='1'/>"), {.max_pieces = 3}), "too-large");
  std::string deep = Path("M0 0 1 1");
  for (int i = 0; i < 300; ++i) deep = "<g>" + deep + "</g>";
  EXPECT_EQ(ErrorOf(Svg(deep)), "too-large");
  EXPECT_EQ(EndsOf(Svg("<metadata>" + deep + "</metadata>" + Path("M0 0 2 2"))), "0,0 2,2");
}

TEST(SvgErrors, WhatGrowsWithoutBoundIsTooLarge) {
  const ReadSvgOptions small{.max_bytes = 1 << 20};
  std::string laughs = "<!DOCTYPE svg [<!ENTITY a0 'ha'>", uses = Path("M0 0", "id='u0'");
  std::string empty = "<!DOCTYPE svg [<!ENTITY e0 ''>";
  for (int i = 1; i < 40; ++i) {
    const std::string now = std::to_string(i), before = std::to_string(i - 1);
    laughs += "<!ENTITY a" + now + " '&a" + before + ";&a" + before + ";'>";
    empty += "<!ENTITY e" + now + " '&e" + before + ";&e" + before + ";'>";
    uses += "<g id='u" + now + "'><use href='#u" + before + "'/><use href='#u" + before + "'/></g>";
  }
  const std::string path = Path("M0 0 1 1");
  EXPECT_EQ(ErrorOf(laughs + "]>" + Svg("<title>&a39;</title>" + path), small), "too-large");
  EXPECT_EQ(EndsOf(empty + "]>" + Svg("<title>&e39;</title>" + path)), "0,0 1,1");
  EXPECT_EQ(ErrorOf(Svg("<defs>" + uses + "</defs><use href='#u39'/>"), small), "too-large");
  std::string rules, elements;
  for (int i = 0; i < 3000; ++i) rules += ".a.b{x:y}", elements += "<g class='a c'/>";
  EXPECT_EQ(ErrorOf(Svg("<style>" + rules + "</style>" + elements + path), small), "too-large");
  std::string chain = "<!DOCTYPE svg [<!ENTITY c0 'x'>";
  for (int i = 1; i < 500; ++i) {
    chain += "<!ENTITY c" + std::to_string(i) + " '&c" + std::to_string(i - 1) + ";'>";
  }
  EXPECT_EQ(ErrorOf(chain + "]>" + Svg("<title>&c499;</title>" + path)), "too-large");
}

TEST(SvgWarnings, FaultyAttributesAreReportedAndIgnored) {
  for (const char* attribute :
       {"transform='rotate(1'", "transform='turn(1)'", "transform='scale()'",
        "transform='matrix(1 2 3)'", "transform='rotate(1 2)'"}) {
    const Outcome<Sketch> outcome = ReadSvg(Svg(Path("M0 0 1 1", attribute)));
    ASSERT_TRUE(outcome.ok()) << attribute;
    EXPECT_EQ(CountOf(outcome, "bad-attribute"), 1) << attribute;
    EXPECT_EQ(testing::Ends(outcome->strokes[0]), "0,0 1,1");
  }
  const Outcome<Sketch> others = ReadSvg(Svg(
      "<circle r='five'/><rect width='1 2' height='1'/>" + Path("M0 0 1 1"), "viewBox='0 0 x'"));
  EXPECT_EQ(CountOf(others, "bad-attribute"), 3);
}

TEST(Sketch, BoundsHoldAllStrokesAndAreEmptyWithoutAny) {
  EXPECT_TRUE(Bounds(Sketch{}).isEmpty());
  const Sketch sketch{Strokes(Svg(Path("M0 0C0 4 3 4 3 0") + Path("M-1 1 0 2")))};
  EXPECT_LT((Bounds(sketch).min() - Vector2d(-1, 0)).norm(), 1e-15);
  EXPECT_LT((Bounds(sketch).max() - Vector2d(3, 3)).norm(), 1e-15);
}

}  // namespace
}  // namespace lascaux

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "lascaux/sketch/depth_graph.h"
#include "sketch/svg_text.h"

/// Small animals, each drawn in another manner, and which of their parts are limbs, pairs and what
/// lies in the plane.

namespace lascaux {
namespace {

using namespace testing;
using Eigen::Vector2d;

/// A place in the drawing and what the part there has to be; `near` is a place in the near limb
/// that a background part belongs to.
struct Want {
  Vector2d at;
  PartRole role;
  std::optional<Vector2d> near = std::nullopt;
};

struct Read {
  Parts parts;
  DepthGraph graph;
};

std::optional<Read> ReadDrawing(const std::string& content) {
  const auto sketch = ReadSvg(Svg(content));
  if (!sketch) return std::nullopt;
  const auto map = BuildPlanarMap(*sketch);
  if (!map) return std::nullopt;
  const auto parts = FindParts(*map);
  const auto graph = OrderByDepth(*map, *parts);
  if (!graph) return std::nullopt;
  return Read{*parts, *graph};
}

/// The smallest part that is built or behind, around a place.
std::optional<int> PartAt(const Read& read, const Vector2d& at) {
  std::optional<int> best;
  const auto area = [&](int i) {
    return SignedArea(read.parts.parts[static_cast<std::size_t>(i)].outline.points);
  };
  for (int i = 0; i < static_cast<int>(read.parts.parts.size()); ++i) {
    if (!Contains(read.parts.parts[static_cast<std::size_t>(i)].outline.points, at)) continue;
    if (!best || area(i) < area(*best)) best = i;
  }
  return best;
}

void ExpectStructure(const std::string& content, const std::vector<Want>& wants) {
  const auto read = ReadDrawing(content);
  ASSERT_TRUE(read);
  for (const Want& want : wants) {
    SCOPED_TRACE("at " + std::to_string(want.at.x()) + ", " + std::to_string(want.at.y()));
    const auto part = PartAt(*read, want.at);
    ASSERT_TRUE(part);
    const DepthNode& node = read->graph.nodes[static_cast<std::size_t>(*part)];
    EXPECT_STREQ(Name(node.role), Name(want.role));
    if (want.near) {
      EXPECT_EQ(node.pair, PartAt(*read, *want.near));
    }
  }
}

/// Legs with suggestive curves, their far sides, and one ear behind the head.
const char* const kCalf =
    R"(<path d="M125,140 C122,155 120,160 120,170 C118,210 120,240 116,270 C116,278 140,278 142,270 C144,240 148,215 150,188 C151,175 152,165 152,150"/>
<path d="M120,170 C112,150 108,140 104,125 C95,120 70,128 50,122 C40,112 44,98 56,94 C70,84 80,66 96,62 C112,58 122,70 130,80 C160,92 240,78 290,88 C320,94 332,120 328,150 C326,180 334,200 330,230 C328,250 330,262 326,272 C324,280 300,280 302,270 C306,240 300,215 290,185 C285,170 283,150 288,130"/>
<path d="M290,185 C250,196 190,196 150,188"/>
<path d="M97,62 C98,40 112,30 122,28 C124,44 120,58 112,64"/>
<path d="M158,190 C164,215 160,245 164,270 C164,278 186,278 186,270 C184,240 188,215 186,193"/>
<path d="M262,192 C262,220 256,240 258,268 C258,276 280,276 280,268 C280,250 290,225 298,208"/>
<circle cx="70" cy="104" r="3"/>
)";

/// No suggestive curve at all: the far sides show which bumps are limbs; a tail points up.
const char* const kGoat =
    R"(<path d="M120,170 C112,150 108,140 104,125 C95,120 70,128 50,122 C40,112 44,98 56,94 C66,86 74,76 84,70 C80,50 84,34 94,22 C104,34 108,50 106,66 C116,68 124,74 130,80 C160,92 240,78 290,88 C320,94 332,120 328,150 C326,180 334,200 330,230 C328,250 330,262 326,272 C324,280 300,280 302,270 C306,240 300,215 290,185 C250,196 190,196 150,188 C148,215 144,240 142,270 C140,278 116,278 116,270 C120,240 118,210 120,170"/>
<path d="M103,40 C108,30 116,24 124,20 C128,36 126,56 120,72"/>
<path d="M120,200 C112,220 104,245 96,262 C92,270 112,276 116,268"/>
<path d="M292,190 C280,210 268,240 262,264 C260,274 280,276 284,268 C286,256 296,244 303,232"/>
<path d="M322,112 C340,96 352,92 362,94 C356,108 344,120 327,128"/>
<circle cx="66" cy="106" r="3"/>
)";

/// Legs and head as closed cells around the wool.
const char* const kLamb =
    R"(<path d="M110,150 C90,130 96,104 118,104 C122,84 148,78 160,92 C172,74 204,74 212,92 C228,76 258,80 264,98 C286,94 302,112 296,132 C312,146 304,172 286,172 C276,190 250,190 242,178 C230,192 204,192 196,178 C184,192 158,190 150,176 C130,184 108,172 110,150Z"/>
<path d="M113,160 C90,168 66,160 58,142 C52,122 70,104 100,114"/>
<path d="M146,181 C146,205 148,230 144,256 L168,258 C172,230 170,205 170,186"/>
<path d="M176,187 C178,205 176,225 178,244 L198,244 C200,225 198,205 200,184"/>
<path d="M254,187 C254,210 256,235 252,258 L278,258 C280,235 278,210 276,183"/>
<path d="M301,140 C316,136 324,150 316,162 C312,168 306,166 303,160"/>
<circle cx="76" cy="132" r="4"/>
)";

/// Fins on an animal without a limb.
const char* const kFish =
    R"(<path d="M40,150 C90,90 200,80 320,140 L320,160 C200,215 90,210 40,150Z"/>
<path d="M320,140 C340,120 360,104 380,100 C370,130 370,170 380,200 C360,192 340,178 320,160"/>
<path d="M140,104 C160,70 190,62 220,64 C212,80 214,96 222,107"/>
<path d="M150,195 C156,214 170,226 190,230 C188,216 190,206 196,198"/>
<circle cx="80" cy="140" r="5"/>
)";

/// Near legs only, a far ear, a tail, a haunch without an end.
const char* const kHare =
    R"(<path d="M60,150 C56,132 70,116 92,108 C96,80 104,50 116,34 C128,52 130,84 122,110 C136,120 146,130 160,132 C220,110 290,130 310,180 C320,210 314,240 300,256 L190,256 C180,256 178,244 190,242"/>
<path d="M116,60 C124,46 138,34 150,30 C156,56 146,88 126,112"/>
<path d="M60,150 C62,166 84,172 100,170 C104,190 112,206 122,216 C118,232 104,240 96,246 C88,254 98,260 112,258 C134,256 150,246 158,232 C162,224 166,214 164,204"/>
<path d="M122,216 C126,206 130,200 136,196"/>
<path d="M158,232 C170,238 180,240 190,242"/>
<path d="M190,242 C206,238 216,236 226,240"/>
<path d="M313,222 C330,214 344,226 338,242 C332,252 316,250 307,246"/>
<circle cx="84" cy="136" r="4"/>
)";

TEST(Limbs, ALoneEarIsOneOfAPair) {
  ExpectStructure(kCalf, {{{200, 140}, PartRole::kBody},
                          {{130, 250}, PartRole::kForeground},
                          {{174, 262}, PartRole::kBackground, Vector2d(130, 250)},
                          {{316, 260}, PartRole::kForeground},
                          {{268, 262}, PartRole::kBackground, Vector2d(316, 260)},
                          {{113, 45}, PartRole::kForeground}});
}

TEST(Limbs, CellsInATangleAreNoEars) {
  // A larger cell behind the calf's ear, along it and the neck: both are pieces of one head.
  ExpectStructure(std::string(kCalf) + R"(<path d="M122,28C150,-10 190,-20 200,0L170,87"/>)",
                  {{{200, 140}, PartRole::kBody},
                   {{113, 45}, PartRole::kSagittal},
                   {{160, 40}, PartRole::kSagittal}});
}

/// The calf with far legs that are open: one begins 5 % of the size below the belly, one on it, and
/// neither foot reaches the near leg.
std::string WithOpenFarLegs(const std::string& far_legs) {
  std::string calf = kCalf;
  const std::size_t front = calf.find("<path d=\"M158,190"), end = calf.find("<circle");
  return calf.replace(front, end - front, far_legs);
}

TEST(Limbs, FarLegsMayBeOpenLines) {
  ExpectStructure(
      WithOpenFarLegs(R"(<path d="M184,206C184,226 186,250 184,268C182,276 166,278 156,272"/>
                                     <path d="M262,192C262,220 256,240 258,268C262,276 276,276 282,268"/>)"),
      {{{200, 140}, PartRole::kBody},
       {{130, 250}, PartRole::kForeground},
       {{174, 262}, PartRole::kBackground, Vector2d(130, 250)},
       {{316, 260}, PartRole::kForeground},
       {{268, 262}, PartRole::kBackground, Vector2d(316, 260)}});
}

TEST(Limbs, LinesThatJustComeDownAreNoLegs) {
  // A far leg of one line, and a tail beside the rump.
  const auto read = ReadDrawing(WithOpenFarLegs(R"(<path d="M184,192C184,226 186,250 184,268"/>
      <path d="M328,110C345,120 348,150 342,180C338,200 340,240 336,262"/>)"));
  ASSERT_TRUE(read);
  EXPECT_FALSE(PartAt(*read, {170, 250}));
  EXPECT_FALSE(PartAt(*read, {336, 200}));
}

TEST(Limbs, TwoCurvesThatTheContourJoinsAreOneLimb) {
  // The shoulder's curve ends far above the front one and points back: as a pair they are dear.
  const auto read = ReadDrawing(R"(
      <path d="M311 508L300 560C298 585 325 595 345 580L388 493L433 411C600 440 700 420 774 380
               C800 450 810 520 830 590C845 610 870 605 872 590C890 520 910 450 915 360
               C920 200 800 50 600 52C400 60 250 140 195 225C170 320 120 370 60 400L80 490
               C160 515 250 505 311 508L310 400"/>
      <path d="M433 411C470 350 440 290 418 260"/>)");
  ASSERT_TRUE(read);
  const auto leg = PartAt(*read, {330, 560});
  ASSERT_TRUE(leg);
  const Part& part = read->parts.parts[static_cast<std::size_t>(*leg)];
  ASSERT_TRUE(part.root);
  EXPECT_STREQ(Name(part.root->evidence), "two-curves");
}

TEST(Limbs, HoovesAreMoreOfTheirLegs) {
  // A line across each leg; what is below it is over 0.35 % of the animal, and no part by itself.
  const std::string hooves = R"(<path d="M117,255L141,256"/><path d="M163,255L187,256"/>)";
  ExpectStructure(kCalf + hooves, {{{130, 250}, PartRole::kForeground},
                                   {{174, 250}, PartRole::kBackground, Vector2d(130, 250)}});
  const auto read = ReadDrawing(kCalf + hooves), plain = ReadDrawing(kCalf);
  ASSERT_TRUE(read && plain);
  EXPECT_EQ(read->parts.parts.size(), plain->parts.parts.size());
  EXPECT_EQ(PartAt(*read, {130, 270}), PartAt(*read, {130, 200}));
}

TEST(Limbs, HoovesThatAreNotDrawnEvenlyAreMoreOfTheirLegs) {
  // The leg's line ends with a hook, and the hoof's begins a little above it.
  std::string calf = kCalf;
  const std::string flank = "120,170 C118,210 120,240 116,270";
  calf.replace(calf.find(flank), flank.size(),
               "120,170 C118,210 119,230 117,254 L119,254.4 L116,253.9 L116,270");
  const auto read = ReadDrawing(calf + R"(<path d="M119,254.4L141,256"/>)");
  ASSERT_TRUE(read);
  EXPECT_EQ(PartAt(*read, {130, 270}), PartAt(*read, {130, 200}));
}

/// What the order in depth says by that code.
Diagnostics Findings(const std::string& content, const std::string& code) {
  const auto sketch = ReadSvg(Svg(content));
  const auto map = BuildPlanarMap(*sketch);
  const auto graph = OrderByDepth(*map, *FindParts(*map));
  Diagnostics found;
  for (const Diagnostic& d : graph.diagnostics()) {
    if (d.code == code) found.push_back(d);
  }
  return found;
}

TEST(Limbs, LinesThatAreLeftOutAreNamedByThePlaceOfTheLongest) {
  EXPECT_TRUE(Findings(kCalf, "lines-left-out").empty());
  const std::string whisker = R"(<path d="M 420 100 L 440 100"/>)";
  EXPECT_TRUE(Findings(kCalf + whisker, "lines-left-out").empty());
  const Diagnostics found =
      Findings(kCalf + whisker + R"(<path d="M 420 120 L 480 220 L 420 320"/>)", "lines-left-out");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().severity, Severity::kWarning);
  ASSERT_TRUE(found.front().at);
  EXPECT_LT((*found.front().at - Vector2d(480, 220)).norm(), 1);
}

TEST(Limbs, ASecondOutlineIsNamedByItsPlace) {
  EXPECT_TRUE(Findings(kCalf, "outline-apart").empty());
  const Diagnostics apart =
      Findings(std::string(kCalf) + R"(<circle cx="420" cy="180" r="40"/>)", "outline-apart");
  ASSERT_EQ(apart.size(), 1u);
  EXPECT_EQ(apart.front().severity, Severity::kWarning);
  ASSERT_TRUE(apart.front().at);
  EXPECT_LT((*apart.front().at - Vector2d(420, 180)).norm(), 1);
}

TEST(Limbs, FarSidesShowWhereNearLimbsAre) {
  ExpectStructure(kGoat, {{{200, 140}, PartRole::kBody},
                          {{130, 250}, PartRole::kForeground},
                          {{104, 262}, PartRole::kBackground, Vector2d(130, 250)},
                          {{316, 260}, PartRole::kForeground},
                          {{272, 264}, PartRole::kBackground, Vector2d(316, 260)},
                          {{94, 40}, PartRole::kForeground},
                          {{118, 40}, PartRole::kBackground, Vector2d(94, 40)},
                          {{350, 100}, PartRole::kSagittal}});
}

TEST(Limbs, ClosedCellsBelowTheBodyAreLegs) {
  ExpectStructure(kLamb, {{{200, 140}, PartRole::kBody},
                          {{70, 145}, PartRole::kSagittal},
                          {{156, 240}, PartRole::kForeground},
                          {{188, 235}, PartRole::kBackground, Vector2d(156, 240)},
                          {{266, 240}, PartRole::kForeground},
                          {{312, 150}, PartRole::kSagittal}});
}

TEST(Limbs, LegsOfASilhouetteMayStandForward) {
  // 60 degrees from the vertical. Where another leg comes straight down, such a lobe is none.
  const std::string
      crouching = R"(<path d="M60 160C60 100 140 60 220 80C270 90 300 120 300 150
      C300 170 290 180 262 188L332 226L322 236L246 200C)",
      hind = R"(200 208 150 208 120 200L182 226L172 236L92 192C70 185 60 175 60 160Z"/>)",
      down = R"(200 208 150 208 124 200L118 236L100 236L92 192C70 185 60 175 60 160Z"/>)";
  ExpectStructure(crouching + hind, {{{160, 140}, PartRole::kBody},
                                     {{310, 222}, PartRole::kForeground},
                                     {{164, 226}, PartRole::kForeground}});
  ExpectStructure(crouching + down,
                  {{{310, 222}, PartRole::kBody}, {{109, 226}, PartRole::kForeground}});
}

TEST(Limbs, LegsOfAToyMayBeStoutAndRound) {
  // Hardly longer than wide, and the belly runs into them in curves.
  ExpectStructure(
      R"(<path d="M60 130C50 40 510 40 500 130V225C500 236 530 236 530 250C530 270 420 262 420 230
                     C420 190 404 176 390 176H170C156 176 140 190 140 230C140 262 30 270 30 250C30 236 60 236 60 225Z"/>)",
      {{{280, 120}, PartRole::kBody},
       {{460, 210}, PartRole::kForeground},
       {{100, 210}, PartRole::kForeground}});
}

TEST(Limbs, HornsAreNoLegsWhereTheHeadIsLookedFor) {
  // The calf without its eye and with a horn that has suggestive curves: the ear behind it is one.
  std::string calf = kCalf;
  calf.erase(calf.find("<circle"));
  const std::string nose = "C40,112 44,98 56,94 ";
  calf.replace(calf.find(nose), nose.size(), "L44,112 L20,70 L56,94 ");
  calf += R"(<path d="M44,112 L54,116"/><path d="M56,94 L66,100"/>)";
  ExpectStructure(calf, {{{200, 140}, PartRole::kBody},
                         {{38, 94}, PartRole::kForeground},
                         {{113, 45}, PartRole::kForeground}});
}

TEST(Limbs, ARoleTurnsWhereItsMarginIsNought) {
  // A cell below a body, shorter and longer beside a leg: from a bump in the plane to a leg.
  double before = -1;
  int turns = 0;
  for (int length = 20; length <= 100; length += 4) {
    SCOPED_TRACE(length);
    const std::string content = R"(<path d="M60 80H340V160H60Z"/><path d="M260 160V260H300V160"/>
        <path d="M100 160v)" + std::to_string(length) +
                                "h40V160\"/>";
    const auto read = ReadDrawing(content);
    ASSERT_TRUE(read);
    const auto cell = PartAt(*read, {120, 170});
    ASSERT_TRUE(cell);
    const DepthNode& node = read->graph.nodes[static_cast<std::size_t>(*cell)];
    ASSERT_TRUE(node.choice);
    EXPECT_GE(node.choice->Margin(), 0);
    const bool leg = node.role == PartRole::kForeground;
    const double score = leg ? node.choice->score : node.choice->runner_up_score;
    EXPECT_EQ(leg, score >= 0);
    EXPECT_GE(score, before);
    turns += leg && before < 0 ? 1 : 0;
    EXPECT_EQ(Findings(content, "limb-guessed").size(),
              // The other leg is a cell, too; a bump is a guess only near the turn.
              leg || node.choice->Margin() < 0.1 ? 2u : 1u);
    before = score;
  }
  EXPECT_EQ(turns, 1);
}

TEST(Limbs, FinsOfAnAnimalWithoutLimbsLieInThePlane) {
  ExpectStructure(kFish, {{{200, 140}, PartRole::kBody},
                          {{365, 150}, PartRole::kSagittal},
                          {{190, 80}, PartRole::kSagittal},
                          {{170, 215}, PartRole::kSagittal}});
}

TEST(Limbs, TheNearEarIsTheBumpBesideTheFarOne) {
  ExpectStructure(kHare, {{{240, 180}, PartRole::kBody},
                          {{130, 245}, PartRole::kForeground},
                          {{112, 60}, PartRole::kForeground},
                          {{140, 50}, PartRole::kBackground, Vector2d(112, 60)},
                          {{325, 234}, PartRole::kSagittal}});
}

TEST(Limbs, EarsMaySpread) {
  // The far ear stands upright, the near one lies back by 70 degrees from it.
  ExpectStructure(R"(
      <path d="M262 120C300 150 310 200 270 230C280 260 270 290 240 300L110 300C60 280 60 190 120 160
               C150 148 180 146 200 146L128 92C104 66 138 34 164 58L220 106C234 108 250 112 262 120Z"/>
      <path d="M214 102L212 30C214 6 252 6 256 30L258 117"/>)",
                  {{{180, 220}, PartRole::kBody},
                   {{150, 76}, PartRole::kForeground},
                   {{236, 40}, PartRole::kBackground, Vector2d(150, 76)}});
}

TEST(Limbs, WhatHoldsAnEyeIsNoFarSide) {
  // The far ear of the goat, with an eye: a face.
  const auto read = ReadDrawing(std::string(kGoat) + R"(<circle cx="119" cy="40" r="3"/>)");
  ASSERT_TRUE(read);
  const auto face = PartAt(*read, {112, 52});
  ASSERT_TRUE(face);
  EXPECT_NE(read->graph.nodes[static_cast<std::size_t>(*face)].role, PartRole::kBackground);
}

TEST(Limbs, TheLargerHalfOfAFaceIsNoLimbOfIt) {
  const auto read = ReadDrawing(R"(
      <path d="M60 60C120 20 250 20 300 60C310 30 340 30 360 60C380 90 400 100 390 120
               C370 160 330 160 290 145C220 160 120 160 60 140C30 120 30 80 60 60Z"/>
      <path d="M300 60C312 70 320 80 324 92"/>
      <path d="M290 145C306 140 318 131 324 118"/>)");
  ASSERT_TRUE(read);
  for (const Part& part : read->parts.parts) EXPECT_NE(part.kind, PartKind::kLimb);
}

}  // namespace
}  // namespace lascaux

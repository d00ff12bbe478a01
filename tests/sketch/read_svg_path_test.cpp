#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sketch/svg_text.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using testing::CountOf;
using testing::Ends;
using testing::EndsOf;
using testing::ForSeeds;
using testing::MessageOf;
using testing::Path;
using testing::Random;
using testing::Strokes;
using testing::Svg;

std::string PathEnds(std::string_view d) { return EndsOf(Svg(Path(d))); }

TEST(SvgPath, AllCommandsMoveThePen) {
  EXPECT_EQ(PathEnds("M1 2L3 4H5V6C1 1 2 2 7 8S3 3 9 10Q1 1 11 12T13 14A1 1 0 0 1 13 14.5"),
            PathEnds("m1 2l2 2h2v2c-4-5-3-4 2 2s-4-5 2 2q-10-9 2 2t2 2a1 1 0 0 1 0 .5"));
  EXPECT_EQ(PathEnds("M1 2L3 4H5V6C1 1 2 2 7 8S3 3 9 10Q1 1 11 12T13 14"),
            "1,2 3,4 5,4 5,6 7,8 9,10 11,12 13,14");
}

TEST(SvgPath, NumbersMayBePacked) {
  EXPECT_EQ(PathEnds("M.5.5-1-1+2.5e0.5E1"), "0.5,0.5 -1,-1 2.5,5");
  EXPECT_EQ(PathEnds("M 1,2\n\t3 ,4"), "1,2 3,4");
  EXPECT_EQ(PathEnds("M0 0L5.,1"), "0,0 5,1");
  EXPECT_EQ(PathEnds("M0 0L1e-400 1"), "0,0 0,1");
}

TEST(SvgPath, ArcFlagsMayBeGluedToWhatFollows) {
  const std::string apart = PathEnds("M0 0a1 1 0 0 1 1 1a2 2 0 1 0 .5 .5");
  EXPECT_EQ(PathEnds("M0 0a1 1 0 011 1a2 2 0 10.5.5"), apart);
}

TEST(SvgPath, CommandsRepeatAndMovesGoOnAsLines) {
  EXPECT_EQ(PathEnds("M0 0 1 1 2 0"), "0,0 1,1 2,0");
  EXPECT_EQ(PathEnds("m1 1 1 1 1 0"), "1,1 2,2 3,2");
  EXPECT_EQ(PathEnds("M0 0h1 1 1"), "0,0 1,0 2,0 3,0");
}

TEST(SvgPath, EachSubpathIsAStrokeOfItsOwn) {
  const auto strokes = Strokes(Svg(Path("M0 0L1 0 1 1zm5 5L6 6M7 7", "id='p'")));
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_TRUE(strokes[0].closed);
  EXPECT_FALSE(strokes[1].closed);
  EXPECT_EQ(Ends(strokes[0]), "0,0 1,0 1,1 0,0");
  EXPECT_EQ(Ends(strokes[1]), "5,5 6,6");
  EXPECT_EQ(strokes[0].svg_id, "p");
  EXPECT_EQ(strokes[1].svg_id, "p");
}

TEST(SvgPath, AfterClosingThePenIsBackAtTheStart) {
  EXPECT_EQ(PathEnds("M1 1h2v2zl-1 0"), "1,1 3,1 3,3 1,1; 1,1 0,1");
}

TEST(SvgPath, ClosingALoopThatIsThereAddsNoPiece) {
  EXPECT_EQ(PathEnds("M0 0h2v2L0 0z"), "0,0 2,0 2,2 0,0");
  // 0.1 + 0.2 - 0.3 is not 0 in floating point.
  const Outcome<Sketch> rounded = ReadSvg(Svg(Path("M0 0h.1h.2v1h-.3z")));
  ASSERT_TRUE(rounded.ok());
  const Outcome<Sketch> drift = ReadSvg(Svg(Path("M0 0h.1h.2v1l-.3-1z")));
  ASSERT_TRUE(drift.ok());
  EXPECT_EQ(drift->strokes[0].pieces.size(), 4u);
  EXPECT_TRUE(drift->strokes[0].closed);
  EXPECT_EQ(drift->strokes[0].pieces.back().p[3], Vector2d(0, 0));
  EXPECT_TRUE(drift.diagnostics().empty());
}

TEST(SvgPath, CurvesKeepTheirControlPoints) {
  const auto strokes = Strokes(Svg(Path("M0 0C1 2 3 4 5 6S9 10 11 12")));
  EXPECT_EQ(strokes[0].pieces[0],
            (CubicBezier{{Vector2d(0, 0), Vector2d(1, 2), Vector2d(3, 4), Vector2d(5, 6)}}));
  EXPECT_EQ(strokes[0].pieces[1].p[1], Vector2d(7, 8));
}

TEST(SvgPath, SmoothCommandsMirrorOnlyTheirOwnKind) {
  const auto strokes = Strokes(Svg(Path("M0 0Q1 2 3 4S9 10 11 12T5 5")));
  EXPECT_EQ(strokes[0].pieces[1].p[1], Vector2d(3, 4));
  EXPECT_EQ(strokes[0].pieces[2].p[1], Vector2d(11, 12));
}

TEST(SvgPath, QuadraticCurvesAreTheSameCurvesAsCubics) {
  const auto strokes = Strokes(Svg(Path("M0 0Q2 4 6 0T12 0")));
  for (const double t : {0.2, 0.5, 0.9}) {
    const Vector2d expected = 2 * (1 - t) * t * Vector2d(2, 4) + t * t * Vector2d(6, 0);
    EXPECT_LT((strokes[0].pieces[0].At(t) - expected).norm(), 1e-14);
    const Vector2d second =
        Vector2d(6, 0) + 2 * (1 - t) * t * Vector2d(4, -4) + t * t * Vector2d(6, 0);
    EXPECT_LT((strokes[0].pieces[1].At(t) - second).norm(), 1e-14);
  }
}

TEST(SvgPath, ArcsRunAlongTheirEllipses) {
  ForSeeds(300, [](Random& random) {
    const double rx = random.LogUniform(0.1, 100), ry = random.LogUniform(0.1, 100);
    const double turn = random.Uniform(-400, 400);
    const double begin = random.Uniform(0, 2 * std::numbers::pi);
    const double sweep = random.Uniform(-6.2, 6.2);
    const Eigen::Rotation2Dd rotation(turn * std::numbers::pi / 180);
    const Vector2d centre(random.Uniform(-50, 50), random.Uniform(-50, 50));
    const auto on_ellipse = [&](double a) -> Vector2d {
      return centre + rotation * Vector2d(rx * std::cos(a), ry * std::sin(a));
    };
    const Vector2d from = on_ellipse(begin), to = on_ellipse(begin + sweep);
    std::ostringstream d;
    d.precision(17);
    d << "M" << from.x() << " " << from.y() << "A" << rx << " " << ry << " " << turn << " "
      << (std::abs(sweep) > std::numbers::pi) << (sweep > 0) << to.x() << " " << to.y();
    const auto strokes = Strokes(Svg(Path(d.str())));
    ASSERT_EQ(strokes.size(), 1u);
    const auto& pieces = strokes[0].pieces;
    EXPECT_EQ(pieces.front().p[0], from);
    EXPECT_EQ(pieces.back().p[3], to);
    EXPECT_EQ(pieces.size(),
              static_cast<std::size_t>(std::ceil(std::abs(sweep) / (std::numbers::pi / 4) - 1e-9)));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (const double t : {0.0, 0.3, 0.5, 0.8}) {
        const Vector2d local = rotation.inverse() * (pieces[i].At(t) - centre);
        const double radius = std::hypot(local.x() / rx, local.y() / ry);
        // Within what the contract says, and what two nearby ends leave of the centre's digits.
        EXPECT_NEAR(radius, 1, 5e-6 + 1e-9 / std::abs(sweep)) << d.str();
      }
      const double angle =
          begin + sweep * (static_cast<double>(i) + 0.5) / static_cast<double>(pieces.size());
      EXPECT_LT((pieces[i].At(0.5) - on_ellipse(angle)).norm(), 1e-5 * std::max(rx, ry)) << d.str();
    }
  });
}

TEST(SvgPath, ArcsThatAreTooSmallGrowAndThoseWithoutARadiusAreLines) {
  const auto grown = Strokes(Svg(Path("M0 0A1 1 0 0 1 10 0")));
  EXPECT_LT((Bounds(Sketch{grown}).min() - Vector2d(0, -5)).norm(), 1e-4);
  EXPECT_LT((Bounds(Sketch{grown}).max() - Vector2d(10, 0)).norm(), 1e-4);
  EXPECT_EQ(Strokes(Svg(Path("M0 0A0 5 0 0 1 9 9")))[0].pieces,
            std::vector<CubicBezier>{Line({0, 0}, {9, 9})});
  EXPECT_EQ(EndsOf(Svg(Path("M0 0A-5-5 0 0 1 5 5"))), EndsOf(Svg(Path("M0 0A5 5 0 0 1 5 5"))));
}

TEST(SvgPath, ErrorsKeepWhatStandsBeforeThem) {
  const struct {
    const char *d, *kept;
    int offset;
  } cases[] = {
      {"M0 0L1 1 2 2 x 3 3", "0,0 1,1 2,2", 13},
      {"M0 0 1 1 2", "0,0 1,1", 10},
      {"M0 0L5 5C1 1 2 2", "0,0 5,5", 16},
      {"M0 0h5A1 1 0 2 1 3 3", "0,0 5,0", 13},
      {"M0 0h5--3", "0,0 5,0", 6},
      {"M0 0h5z9", "0,0 5,0 0,0", 7},
  };
  for (const auto& c : cases) {
    const Outcome<Sketch> outcome = ReadSvg(Svg(Path(c.d, "id='tail'")));
    ASSERT_TRUE(outcome.ok()) << c.d;
    EXPECT_EQ(Ends(outcome->strokes[0]), c.kept) << c.d;
    EXPECT_EQ(CountOf(outcome, "bad-path-data"), 1) << c.d;
    const std::string message = MessageOf(outcome, "bad-path-data");
    EXPECT_NE(message.find("'tail'"), std::string::npos) << message;
    EXPECT_NE(message.find("byte " + std::to_string(c.offset) + ":"), std::string::npos) << message;
  }
  EXPECT_EQ(CountOf(ReadSvg(Svg(Path("L1 1") + Path("M0 0 1 1"))), "bad-path-data"), 1);
}

}  // namespace
}  // namespace lascaux

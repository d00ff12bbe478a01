#include "parse_picture.h"

#include <gtest/gtest.h>

#include <limits>
#include <pugixml.hpp>
#include <string>

#include "lascaux/io/xml_text.h"
#include "picture_style.h"
#include "sample_model.h"
#include "svg_text.h"

namespace lascaux {
namespace {

using testing::SampleModel;

pugi::xml_document Parsed(const std::string& text) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(text.c_str())) << text;
  return document;
}

pugi::xml_node Layer(const pugi::xml_document& document, const char* id) {
  return document.child("svg").find_child_by_attribute("g", "id", id);
}

TEST(ParsePicture, HasALayerForEverythingThatWasFound) {
  Model model = SampleModel();
  model.diagnostics = {At(Warning("gap-closed", "A gap <here> & there."), {1, 1})};
  const auto document = Parsed(ParsePictureText(model));
  for (const char* id : {"parts", "ink", "completions", "discs", "skeleton", "joints", "body",
                         "labels", "diagnostics", "legend"})
    EXPECT_TRUE(Layer(document, id)) << id;
  EXPECT_STREQ(Layer(document, "diagnostics").child("g").child_value("title"),
               "A gap <here> & there.");
}

TEST(ParsePicture, DrawsWhatThereIsWhenTheDrawingWasNotUnderstood) {
  Model model = SampleModel();
  model.parts.reset();
  model.graph.reset();
  model.skeletons.reset();
  model.creature.reset();
  const auto document = Parsed(ParsePictureText(model));
  EXPECT_TRUE(Layer(document, "ink"));
  EXPECT_FALSE(Layer(document, "parts"));
  EXPECT_TRUE(Parsed(ParsePictureText(Model{})).child("svg"));
}

TEST(ParsePicture, PairsHaveOneColour) {
  const PictureStyle style = StyleFor(SampleModel());
  EXPECT_EQ(style.colors[1], style.colors[2]);
  EXPECT_EQ(style.colors[1], style.colors[3]);
  EXPECT_NE(style.colors[0], style.colors[1]);
}

TEST(ParsePicture, LabelsLieInsideTheirParts) {
  const Model model = SampleModel();
  for (int i = 0; i < static_cast<int>(model.parts->parts.size()); ++i) {
    const auto& ring = model.parts->parts[static_cast<std::size_t>(i)].outline.points;
    EXPECT_TRUE(Contains(ring, LabelPlaceOf(model, i).at)) << i;
    EXPECT_TRUE(Contains(ring, InnerPlace(ring).at)) << i;
  }
}

TEST(ParsePicture, AnAngleHasItsLabelInsideItToo) {
  const std::vector<Eigen::Vector2d> angle = {{0, 0}, {10, 0}, {10, 1}, {1, 1}, {1, 10}, {0, 10}};
  EXPECT_TRUE(Contains(angle, InnerPlace(angle).at));
}

TEST(SvgText, NumbersKeepAHundredThousandthOfTheDiagonal) {
  EXPECT_EQ(SvgNumbers(1000)(12.3456), "12.35");
  EXPECT_EQ(SvgNumbers(1)(-0.1234567), "-0.12346");
  EXPECT_EQ(SvgNumbers(1)(2), "2");
  EXPECT_EQ(SvgNumbers(1)(-1e-9), "0");
  EXPECT_EQ(SvgNumbers(1e9)(1200), "1200");
  EXPECT_EQ(SvgNumbers(0)(1.5), "1.5");
}

TEST(EscapeXml, ReservedCharactersAreEscapedAndForbiddenOnesAreSpaces) {
  EXPECT_EQ(EscapeXml("a<b>&\"c\x01\nd"), "a&lt;b&gt;&amp;&quot;c  d");
}

}  // namespace
}  // namespace lascaux

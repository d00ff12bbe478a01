#include "output_plan.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lascaux {
namespace {

using Names = std::vector<std::string>;

std::vector<std::string> Paths(const Names& sketches, const std::vector<OutputRequest>& requests) {
  Diagnostics log;
  const auto plan = PlanOutputs(sketches, requests).MoveInto(log);
  std::vector<std::string> paths;
  if (!plan) return {log.front().code};
  for (const auto& targets : *plan)
    for (const OutputTarget& target : targets) paths.push_back(target.path.string());
  return paths;
}

TEST(OutputPlan, EndingsNameFormatsInAnyCase) {
  Diagnostics log;
  const auto requests =
      ReadOutputNames(Verb::kBuild, {"a.vdb", "a.STL", "a.3mf", "a.glb", "a.obj", "a.ply", "a.usda",
                                     "a.png", "a.json", "a.svg"})
          .MoveInto(log);
  ASSERT_TRUE(requests);
  const std::vector kinds = {OutputKind::kVdb,         OutputKind::kStl, OutputKind::k3mf,
                             OutputKind::kGlb,         OutputKind::kObj, OutputKind::kPly,
                             OutputKind::kUsda,        OutputKind::kPng, OutputKind::kReport,
                             OutputKind::kParsePicture};
  for (std::size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ((*requests)[i].kind, kinds[i]);
}

TEST(OutputPlan, InspectWritesPictureAndDump) {
  Diagnostics log;
  const auto requests = ReadOutputNames(Verb::kInspect, {"a.svg", "a.json"}).MoveInto(log);
  ASSERT_TRUE(requests);
  EXPECT_EQ((*requests)[0].kind, OutputKind::kParsePicture);
  EXPECT_EQ((*requests)[1].kind, OutputKind::kParseDump);
  EXPECT_FALSE(ReadOutputNames(Verb::kInspect, {"a.stl"}).ok());
}

TEST(OutputPlan, UnknownEndingsAreRefusedWithTheListOfKnownOnes) {
  for (const char* name : {"a.jpg", "a.fbx", "a.usd", "a", "a."}) {
    const auto outcome = ReadOutputNames(Verb::kBuild, {name});
    ASSERT_FALSE(outcome.ok()) << name;
    EXPECT_EQ(outcome.diagnostics().front().code, "unknown-format");
    EXPECT_EQ(outcome.diagnostics().front().failure, FailureKind::kUsage);
    EXPECT_NE(outcome.diagnostics().front().message.find(".vdb .stl .3mf .glb .obj .ply .usda"),
              std::string::npos);
  }
}

TEST(OutputPlan, StandardOutputTakesOneVolume) {
  const auto requests = ReadOutputNames(Verb::kBuild, {"-"});
  ASSERT_TRUE(requests.ok());
  EXPECT_EQ((*requests)[0].kind, OutputKind::kVdb);
  const auto plan = PlanOutputs({"-"}, *requests);
  ASSERT_TRUE(plan.ok());
  EXPECT_TRUE(IsStandardOutput((*plan)[0][0]));
  EXPECT_FALSE(IsStandardOutput({OutputKind::kVdb, "./-"}));
  EXPECT_EQ(Paths({"a.svg", "b.svg"}, *requests), (Names{"output-name"}));
  EXPECT_EQ(Paths({"a.svg"}, {{OutputKind::kVdb, "-"}, {OutputKind::kReport, "-"}}),
            (Names{"output-name"}));
  for (const Verb verb : {Verb::kInspect, Verb::kTrace, Verb::kRender})
    EXPECT_EQ(ReadOutputNames(verb, {"-"}).diagnostics().front().code, "stdout-output");
}

TEST(OutputPlan, BracesStandForTheSketchsNameWithoutItsEnding) {
  EXPECT_EQ(Paths({"in/cat.svg", "dog.tiny.svg"}, {{OutputKind::kStl, "out/{}.stl"}}),
            (Names{"out/cat.stl", "out/dog.tiny.stl"}));
  EXPECT_EQ(Paths({"-"}, {{OutputKind::kStl, "{}/{}.stl"}}), (Names{"stdin/stdin.stl"}));
  EXPECT_EQ(Paths({"cat.svg"}, {{OutputKind::kStl, "out.stl"}}), (Names{"out.stl"}));
}

TEST(OutputPlan, SeveralSketchesNeedBraces) {
  EXPECT_EQ(Paths({"a.svg", "b.svg"}, {{OutputKind::kStl, "out.stl"}}), (Names{"output-name"}));
}

TEST(OutputPlan, NoOutputIsWrittenTwice) {
  EXPECT_EQ(Paths({"x/a.svg", "y/a.svg"}, {{OutputKind::kStl, "{}.stl"}}), (Names{"output-name"}));
  EXPECT_EQ(Paths({"a.svg"}, {{OutputKind::kStl, "o.stl"}, {OutputKind::kStl, "./o.stl"}}),
            (Names{"output-name"}));
}

TEST(OutputPlan, NoInputIsOverwritten) {
  EXPECT_EQ(Paths({"a.svg"}, {{OutputKind::kParsePicture, "./a.svg"}}), (Names{"output-name"}));
  EXPECT_EQ(Paths({"a.svg", "b.svg"}, {{OutputKind::kParsePicture, "{}.svg"}}),
            (Names{"output-name"}));
}

}  // namespace
}  // namespace lascaux

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "parse_dump.h"
#include "report.h"
#include "sample_model.h"

namespace lascaux {
namespace {

using nlohmann::json;
using testing::SampleModel;

json Report(const Model& model) { return json::parse(ReportText(model, ReportTimings::kWith)); }

TEST(Report, HasEveryFieldOfItsFormatInAnyCase) {
  for (const Model& model : {Model{}, SampleModel()}) {
    const json report = Report(model);
    for (const char* field : {"format", "sketch", "model_from_sketch", "body", "parts",
                              "diagnostics", "grid", "mesh", "fidelity", "timings_ms"})
      EXPECT_TRUE(report.contains(field)) << field;
    EXPECT_EQ(report["format"], "lascaux.report/1");
  }
}

TEST(Report, WhatWasNotMeasuredIsNull) {
  const json report = Report(SampleModel());
  for (const char* field : {"model_from_sketch", "grid", "mesh", "fidelity"})
    EXPECT_TRUE(report[field].is_null()) << field;
  Model model = SampleModel();
  model.facts.emplace();
  EXPECT_TRUE(Report(model)["mesh"]["self_intersections"].is_null());
  EXPECT_TRUE(Report(model)["mesh"]["genus"].is_null());
  EXPECT_EQ(Report(model)["mesh"]["closed"], false);
}

TEST(Report, PartsHaveRolesPartnersAndDepths) {
  const json parts = Report(SampleModel())["parts"];
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0]["role"], "body");
  EXPECT_TRUE(parts[0]["relation"].is_null());
  EXPECT_EQ(parts[1]["role"], "foreground");
  EXPECT_EQ(parts[1]["pair"], 2);
  EXPECT_EQ(parts[1]["relation"], "over");
  EXPECT_DOUBLE_EQ(parts[1]["z"], 9);
  EXPECT_EQ(parts[2]["role"], "background");
  EXPECT_EQ(parts[2]["pair"], 1);
  EXPECT_DOUBLE_EQ(parts[2]["z"], -9);
  EXPECT_EQ(parts[3]["name"], "eye-4");
  EXPECT_EQ(parts[3]["relation"], "over-in");
}

TEST(Report, AFarLimbSeenInTwoPiecesIsOnePartWithTwoOutlines) {
  const json parts = Report(SampleModel())["parts"];
  EXPECT_EQ(parts[1]["outlines"].size(), 1u);
  EXPECT_EQ(parts[2]["outlines"].size(), 2u);
}

TEST(Report, TheMatrixTakesTheSketchToTheModel) {
  Model model = SampleModel();
  model.mesh.emplace();
  const json m = Report(model)["model_from_sketch"];
  const Eigen::Vector2d point(3, 2), expected = model.frame->ToModel(point);
  for (std::size_t row = 0; row < 2; ++row)
    EXPECT_DOUBLE_EQ(
        m[row][0].get<double>() * 3 + m[row][1].get<double>() * 2 + m[row][2].get<double>(),
        expected[static_cast<Eigen::Index>(row)]);
}

TEST(Report, TimingsAreTheOnlyThingThatCanBeLeftOut) {
  const Model model = SampleModel();
  json with = Report(model);
  EXPECT_EQ(with["timings_ms"]["total"], 4.0);
  with.erase("timings_ms");
  EXPECT_EQ(with, json::parse(ReportText(model, ReportTimings::kWithout)));
}

TEST(Report, DiagnosticsKeepStrokeAndPlace) {
  Model model;
  model.diagnostics = {At(OnStroke(Warning("gap-closed", "A \"gap\"."), 3), {12.5, 80.1}),
                       Note("a-note", "B.")};
  const json found = Report(model)["diagnostics"];
  EXPECT_EQ(found[0], json::parse(R"({"severity": "warning", "code": "gap-closed",
      "message": "A \"gap\".", "stroke": 3, "at": [12.5, 80.1]})"));
  EXPECT_TRUE(found[1]["stroke"].is_null());
  EXPECT_TRUE(found[1]["at"].is_null());
}

TEST(Report, NamesThatAreNoTextAndNumbersThatAreNoneStayJson) {
  Model model;
  model.file = "c\xff\"\n.svg";
  model.fidelity.emplace();
  model.fidelity->iou = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Report(model)["fidelity"]["iou"].is_null());
}

TEST(ParseDump, HoldsWhatEachStageFound) {
  const json full = json::parse(ParseDumpText(SampleModel()));
  EXPECT_EQ(full["format"], "lascaux.parse/1");
  EXPECT_EQ(full["strokes"][0]["pieces"].size(), 2u);
  EXPECT_EQ(full["parts"][1]["root"]["evidence"], "two-curves");
  EXPECT_EQ(full["graph"]["nodes"][3]["role"], "background");
  EXPECT_EQ(full["skeletons"][0]["discs"][1], json::parse("[3.0, 1.0, 1.0]"));
  EXPECT_EQ(full["creature"][1]["mirrored"], true);
  const json empty = json::parse(ParseDumpText(Model{}));
  for (const char* field : {"strokes", "map", "parts", "graph", "skeletons", "creature"})
    EXPECT_TRUE(empty[field].is_null()) << field;
}

}  // namespace
}  // namespace lascaux

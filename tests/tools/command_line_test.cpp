#include "command_line.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

namespace lascaux {
namespace {

using Arguments = std::vector<std::string>;

CommandLine Understood(const Arguments& arguments) {
  auto parsed = ParseCommandLine(arguments);
  if (const auto* answer = std::get_if<Answer>(&parsed)) ADD_FAILURE() << answer->text;
  return std::get<CommandLine>(parsed);
}

Answer Answered(const Arguments& arguments) {
  const auto parsed = ParseCommandLine(arguments);
  const auto* answer = std::get_if<Answer>(&parsed);
  return answer == nullptr ? Answer{ExitCode::kBug, "understood"} : *answer;
}

TEST(CommandLine, OptionsOfPicturesSetTheFieldsOfTheRenderer) {
  const CommandLine line =
      Understood({"render", "a.vdb", "b.vdb", "-o", "{}.png", "--view", "side,top", "--width",
                  "300", "--height", "200", "--background", "#f00", "--turntable", "8", "--columns",
                  "4", "--grid", "part"});
  EXPECT_EQ(line.verb, Verb::kRender);
  EXPECT_EQ(line.render.models, (Arguments{"a.vdb", "b.vdb"}));
  EXPECT_EQ(line.render.views, (std::vector{View::kSide, View::kTop}));
  EXPECT_EQ(line.render.render.width, 300);
  EXPECT_EQ(line.render.render.height, 200);
  EXPECT_EQ(line.render.render.backdrop, Backdrop::kColor);
  EXPECT_EQ(line.render.render.backdrop_color, (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(line.render.turntable, 8);
  EXPECT_EQ(line.render.columns, 4);
  EXPECT_EQ(line.render.grid, "part");
  const CommandLine build = Understood({"build", "a.svg", "-o", "a.png", "--view", "front,top",
                                        "--picture-size", "256", "--background", "transparent"});
  const PreviewOptions& preview = build.options.pipeline.preview;
  EXPECT_EQ(preview.views, (std::vector{View::kFront, View::kTop}));
  EXPECT_EQ(preview.render.width, 256);
  EXPECT_EQ(preview.render.height, 256);
  EXPECT_EQ(preview.render.backdrop, Backdrop::kTransparent);
}

TEST(CommandLine, ProgramsBringTheirUnitAndVolumeAndWhatIsSaidGoesBefore) {
  const auto write = [](const Arguments& more) {
    Arguments arguments = {"build", "a.svg", "-o", "a.vdb"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Understood(arguments).options.write;
  };
  EXPECT_EQ(write({}).volume, VolumeOptions());
  const WriteOptions unreal = write({"--for", "unreal"});
  EXPECT_EQ(unreal.unit, Unit::kCentimetre);
  EXPECT_EQ(unreal.volume.up, UpAxis::kZ);
  EXPECT_EQ(unreal.volume.floats, VdbFloats::kHalf);
  EXPECT_EQ(unreal.volume.companions, (Companions{.fog = true}));
  const WriteOptions mixed = write({"--color", "--units", "mm", "--parts", "--for", "blender"});
  EXPECT_EQ(mixed.unit, Unit::kMillimetre);
  EXPECT_EQ(mixed.volume.companions, (Companions{.parts = true, .fog = true, .color = true}));
  EXPECT_EQ(mixed.volume.floats, VdbFloats::kFull);
  EXPECT_EQ(write({"--for", "print"}).unit, Unit::kMillimetre);
  EXPECT_EQ(write({"--for", "houdini"}).volume.up, UpAxis::kY);
  EXPECT_EQ(write({"--half"}).volume.floats, VdbFloats::kHalf);
  EXPECT_EQ(Answered({"build", "a.svg", "-o", "a.vdb", "--for", "maya"}).code, ExitCode::kUsage);
}

TEST(CommandLine, OptionsSetTheFieldsOfTheStages) {
  const CommandLine line =
      Understood({"build",  "a.svg",    "b.svg",  "-o",           "{}.vdb",  "-o",
                  "{}.stl", "--report", "{}.txt", "--body",       "12.5,-3", "--blend",
                  "2",      "--size",   "50",     "--resolution", "128",     "--threads",
                  "3",      "--units",  "cm",     "--no-timings", "--quiet"});
  const CommandOptions& options = line.options;
  EXPECT_EQ(line.verb, Verb::kBuild);
  EXPECT_EQ(line.threads, 3);
  EXPECT_EQ(options.sketches, (Arguments{"a.svg", "b.svg"}));
  EXPECT_EQ(options.outputs, (Arguments{"{}.vdb", "{}.stl"}));
  EXPECT_EQ(options.reports, (Arguments{"{}.txt"}));
  EXPECT_EQ(options.pipeline.depth.body, Eigen::Vector2d(12.5, -3));
  EXPECT_EQ(options.pipeline.blend, 2);
  EXPECT_EQ(options.pipeline.size, 50);
  EXPECT_DOUBLE_EQ(options.pipeline.VoxelSize(), 50.0 / 128);
  EXPECT_EQ(options.write.unit, Unit::kCentimetre);
  EXPECT_EQ(options.write.timings, ReportTimings::kWithout);
  EXPECT_EQ(options.verbosity, Verbosity::kQuiet);
}

TEST(CommandLine, DefaultsAreThoseOfTheDocumentation) {
  const CommandLine line = Understood({"build", "a.svg"});
  EXPECT_EQ(line.threads, 0);
  EXPECT_DOUBLE_EQ(line.options.pipeline.VoxelSize(), 100.0 / 256);
  EXPECT_EQ(line.options.write.unit, Unit::kMetre);
  EXPECT_EQ(line.options.pipeline.blend, 4);
}

TEST(CommandLine, VoxelSizeDecidesInsteadOfTheResolution) {
  EXPECT_EQ(Understood({"build", "a.svg", "--voxel-size", "0.2"}).options.pipeline.VoxelSize(),
            0.2);
}

TEST(CommandLine, AnOptionTakesOneFileAndTheOthersAreSketches) {
  // Else the first sketch would be written over.
  const auto build = Understood({"build", "-o", "{}.stl", "a.svg", "b.svg"}).options;
  EXPECT_EQ(build.outputs, (Arguments{"{}.stl"}));
  EXPECT_EQ(build.sketches, (Arguments{"a.svg", "b.svg"}));
  const auto report = Understood({"build", "--report", "{}.json", "a.svg", "b.svg"}).options;
  EXPECT_EQ(report.reports, (Arguments{"{}.json"}));
  EXPECT_EQ(Understood({"render", "-o", "{}.png", "a.vdb", "b.vdb"}).render.models,
            (Arguments{"a.vdb", "b.vdb"}));
}

TEST(CommandLine, AFileMayBeginWithADash) {
  EXPECT_EQ(Understood({"build", "-o", "a.stl", "--", "-a.svg"}).options.sketches,
            (Arguments{"-a.svg"}));
  const Answer answer = Answered({"build", "-a.svg", "-o", "a.stl"});
  EXPECT_EQ(answer.code, ExitCode::kUsage);
  EXPECT_NE(answer.text.find("./-a.svg"), std::string::npos) << answer.text;
}

TEST(CommandLine, WrongOnesAreRefusedInOneLine) {
  const std::vector<Arguments> wrong = {
      {},
      {"bild", "a.svg"},
      {"build"},
      {"build", "a.svg", "--resolution", "0"},
      {"build", "a.svg", "--resolution", "-5"},
      {"build", "a.svg", "--resolution", "many"},
      {"build", "a.svg", "--resolution", "1e300"},
      {"build", "a.svg", "--voxel-size", "nan"},
      {"build", "a.svg", "--voxel-size", "inf"},
      {"build", "a.svg", "--voxel-size", "0.1", "--resolution", "64"},
      {"build", "a.svg", "--size", "-1"},
      {"build", "a.svg", "--blend", "0.5"},
      {"build", "a.svg", "--torso-depth", "0"},
      {"build", "a.svg", "--blend", "nan"},
      {"build", "a.svg", "--body", "3"},
      {"build", "a.svg", "--body", "nan,3"},
      {"build", "a.svg", "--threads", "0"},
      {"build", "a.svg", "--units", "inch"},
      {"build", "a.svg", "--wings", "2"},
      {"build", "-", "--format", "pdf"},
      {"inspect", "a.svg"},
  };
  for (const Arguments& arguments : wrong) {
    const Answer answer = Answered(arguments);
    std::string shown;
    for (const std::string& argument : arguments) shown += argument + " ";
    EXPECT_EQ(answer.code, ExitCode::kUsage) << shown << answer.text;
    EXPECT_EQ(answer.text.find("lascaux: error: usage: "), 0u) << shown << answer.text;
    EXPECT_EQ(answer.text.find('\n'), answer.text.size() - 1) << shown << answer.text;
  }
}

TEST(CommandLine, OverridesAreAFile) {
  EXPECT_EQ(Understood({"build", "a.svg", "--overrides", "x.json"}).options.overrides, "x.json");
}

TEST(CommandLine, WhatIsNotSupportedSaysWhatIs) {
  EXPECT_NE(Answered({"build", "a.svg", "--pose", "drawn"}).text.find("symmetric"),
            std::string::npos);
  EXPECT_EQ(Understood({"build", "a.svg", "--pose", "symmetric"}).verb, Verb::kBuild);
}

TEST(CommandLine, HelpBeginsWithExamples) {
  const Answer help = Answered({"--help"});
  EXPECT_EQ(help.code, ExitCode::kSuccess);
  EXPECT_LT(help.text.find("Examples:"), help.text.find("Usage:"));
  EXPECT_NE(Answered({"build", "--help"}).text.find("--resolution"), std::string::npos);
  for (const std::string verb : {"build", "inspect", "render", "check", "trace"}) {
    const std::string text = Answered({verb, "--help"}).text;
    EXPECT_EQ(std::count_if(text.begin(), text.end(),
                            [](char c) { return c != '\n' && static_cast<unsigned char>(c) < 32; }),
              0)
        << verb;
    if (verb == "build") {
      EXPECT_NE(text.find("--min-wall"), std::string::npos);
    }
  }
  EXPECT_NE(Answered({"--version"}).text.find("OpenVDB"), std::string::npos);
}

}  // namespace
}  // namespace lascaux

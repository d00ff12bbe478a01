#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "choice.h"
#include "picture_arguments.h"
#include "render_arguments.h"
#include "version.h"
#include "volume_arguments.h"

namespace lascaux {
namespace {

constexpr const char* kExamples = R"(Draw an animal from the side. Get a solid one.

Examples:
  lascaux build cat.svg -o cat.vdb -o cat.stl -o cat.png
  lascaux build *.svg -o 'out/{}.stl' --report 'out/{}.json'
  lascaux build cat.svg -o cat.stl --size 80 --resolution 512
  lascaux build cat.svg -o cat.3mf --size 120 --base --min-wall 1.2 --hollow 2
  lascaux build cat.svg -o cat.png --material drawing
  lascaux inspect cat.svg -o parse.svg
  lascaux build photo.jpg -o cat.stl
  lascaux build cat.svg -o cat.vdb --for blender --color
  lascaux build cat.svg -o - | ssh farm 'cat > cat.vdb'
  lascaux trace photo.jpg -o cat.svg
  lascaux render cat.vdb -o views.png --contact-sheet
  lascaux check cat.stl
  cat cat.svg | lascaux build - --format svg -o cat.vdb
)";

constexpr const char* kExitCodes = R"(Exit codes:
  0 done   2 command line   3 input can't be read   4 drawing not understood
  5 output can't be written   6 mesh not printable   1 bug   130 interrupted
)";

/// A number in [least, most]; CLI::Range would let "nan" through.
CLI::Validator Between(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value))
          return fmt::format("'{}' is not a number", text);
        if (value >= least && value <= most) return std::string();
        return fmt::format("{} is not from {} to {}", text, least, most);
      },
      "");
}

/// What every verb has.
void AddInputs(CLI::App& app, CommandLine& line) {
  CommandOptions& options = line.options;
  app.add_option(
         "SKETCH", options.sketches,
         "Drawings: .svg, or pictures (.png .jpg .tif .bmp .webp), which are traced; - reads from "
         "standard input")
      ->required();
  app.add_option("--format", options.format, "What comes from standard input: svg, png or jpg")
      ->check(CLI::IsMember({"svg", "png", "jpg"}));
  app.add_option("--threads", line.threads, "Worker threads (default: all)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.add_flag_callback(
      "--quiet,-q", [&options] { options.verbosity = Verbosity::kQuiet; },
      "No progress and no notes; warnings and errors stay");
  app.allow_extras(false);
}

/// What the verbs have that try to understand the drawing.
void AddShared(CLI::App& app, CommandLine& line) {
  CommandOptions& options = line.options;
  AddInputs(app, line);
  app.add_option_function<std::vector<double>>(
         "--body",
         [&options](const std::vector<double>& xy) {
           if (!std::isfinite(xy[0]) || !std::isfinite(xy[1]))
             throw CLI::ValidationError("--body", "wants two finite numbers, such as 120,80");
           options.pipeline.depth.body = Eigen::Vector2d(xy[0], xy[1]);
         },
         "A point in the torso, in the sketch's units, when the automatic choice is wrong")
      ->delimiter(',')
      ->expected(2)
      ->type_name("X,Y");
  app.add_option("--overrides", options.overrides,
                 "What you know better, as JSON: body, pairs, cuts, strokes to ignore "
                 "(docs/overrides.md); inspect shows the numbers to write there")
      ->type_name("FILE");
}

/// What makes a model fit for a printer.
void AddPrint(CLI::App& app, PipelineOptions& pipeline) {
  constexpr double kLeastWall = 0.05, kLargestWall = 1e4;  // mm
  constexpr std::size_t kFewestFaces = 4;                  // of a closed solid
  constexpr std::size_t kMostFaces = 1'000'000'000;
  app.add_option("--min-wall", pipeline.print.min_wall, "Makes what is thinner this thick")
      ->check(Between(kLeastWall, kLargestWall))
      ->type_name("MM")
      ->group("Printing");
  app.add_flag_callback(
         "--base", [&pipeline] { pipeline.print.base = Base::kWhenItFalls; },
         "A plate under the feet, when it would not stand safely")
      ->group("Printing");
  app.add_option("--hollow", pipeline.print.hollow,
                 "A cavity that leaves walls this thick, with a drain downwards")
      ->check(Between(kLeastWall, kLargestWall))
      ->type_name("MM")
      ->group("Printing");
  app.add_option("--faces", pipeline.faces, "As many triangles at most, if that can be printed")
      ->check(CLI::Range(kFewestFaces, kMostFaces))
      ->type_name("N")
      ->group("Printing");
}

void AddBuild(CLI::App& app, CommandLine& line) {
  constexpr double kLargestResolution = 8192;      // a model of 8192 voxels takes some 20 GB
  constexpr double kLargestSize = 1e6;             // mm: a kilometre
  constexpr double kSmallestSize = 1e-3;           // mm
  constexpr double kSmallestVoxel = 1e-6;          // mm
  constexpr double kLargestBlend = 64;             // the field's own limit on exponents
  constexpr double kNarrowest = 0.2, kWidest = 5;  // of torsos
  CommandOptions& options = line.options;
  PipelineOptions& pipeline = options.pipeline;
  app.add_option("-o,--output", options.outputs,
                 "A file to write, again for each more: .vdb .stl .3mf .glb .obj .ply .usda .png "
                 ".exr .json "
                 "(report) .svg (how the drawing was read); {} stands for the sketch's name, - for "
                 "standard output (as .vdb)")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
  AddShared(app, line);
  auto* resolution =
      app.add_option("--resolution", pipeline.resolution, "Voxels along the longest side")
          ->check(Between(1, kLargestResolution))
          ->capture_default_str()
          ->type_name("N");
  app.add_option("--voxel-size", pipeline.voxel_size, "Edge of a voxel, instead of --resolution")
      ->check(Between(kSmallestVoxel, kLargestSize))
      ->excludes(resolution)
      ->type_name("MM");
  app.add_option("--size", pipeline.size, "Longest side of the model")
      ->check(Between(kSmallestSize, kLargestSize))
      ->capture_default_str()
      ->type_name("MM");
  AddPrint(app, pipeline);
  app.add_option("--blend", pipeline.blend,
                 "How sharply parts meet: 1 is the softest, above 8 nearly a crease")
      ->check(Between(1, kLargestBlend))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--torso-depth", pipeline.placement.torso_depth,
                 "How deep the torso is for its height; below 1 makes it narrower")
      ->check(Between(kNarrowest, kWidest))
      ->capture_default_str()
      ->type_name("N");
  AddChoice<OutlineFit>(
      app, "--fit", pipeline.outline_fit,
      {{"outline", OutlineFit::kExact}, {"none", OutlineFit::kNone}},
      "outline: the side view is the drawing (default); none: medial axes as they are, to compare")
      ->type_name("HOW");
  AddVolume(app, options.write);
  AddViews(app, pipeline.preview.views);
  AddPictureSize(app, "--picture-size", pipeline.preview.render);
  AddBackground(app, pipeline.preview.render);
  AddMaterial(app, pipeline.preview.render);
  app.add_option("--report", options.reports, "Writes the report, whatever the file's ending")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
  app.add_flag_callback(
      "--no-timings", [&options] { options.write.timings = ReportTimings::kWithout; },
      "Leaves the one thing out of the report that differs between equal runs");
  app.add_option_function<std::string>("--pose",
                                       [](const std::string& pose) {
                                         if (pose != "symmetric")
                                           throw CLI::ValidationError(
                                               "--pose", "'" + pose +
                                                             "' is not supported; far "
                                                             "limbs mirror near ones (symmetric)");
                                       })
      ->group("");
}

void AddInspect(CLI::App& app, CommandLine& line) {
  app.add_option(
         "-o,--output", line.options.outputs,
         "A file to write: .svg (parts, junctions, completions, pairs, skeleton and "
         "problems on the drawing), .json (the same as data); {} stands for the sketch's name")
      ->type_name("FILE")
      ->required()
      ->take_all()
      ->allow_extra_args(false);
  AddShared(app, line);
}

void AddTrace(CLI::App& app, CommandLine& line) {
  app.add_option(
         "-o,--output", line.options.outputs,
         "A file to write: .svg (the curves, to be edited and built), .json (how good they are); "
         "{} stands for the sketch's name")
      ->type_name("FILE")
      ->required()
      ->take_all()
      ->allow_extra_args(false);
  AddInputs(app, line);
}

void AddCheck(CLI::App& app, CommandLine& line) {
  CommandOptions& options = line.options;
  app.add_option("MESH", options.sketches, "Meshes (.stl .ply .obj .glb .3mf)")->required();
  app.add_option("-o,--output", options.outputs,
                 "Writes what was found as .json; {} stands for the mesh's name, - for standard "
                 "output")
      ->type_name("FILE")
      ->take_all();
  app.add_option("--threads", line.threads, "Worker threads (default: all)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.add_flag_callback(
      "--quiet,-q", [&options] { options.verbosity = Verbosity::kQuiet; },
      "Only warnings and errors");
}

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// What is wrong with the command line. A file whose name begins with '-' looks like an option.
std::string Complaint(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining(true);
  const auto dashed = std::find_if(extras.begin(), extras.end(), [](const std::string& text) {
    return text.size() > 1 && text.front() == '-';
  });
  if (dashed == extras.end()) return OneLine(error.what());
  return OneLine(fmt::format("there is no option {0}; a file of this name is ./{0}", *dashed));
}

}  // namespace

std::variant<CommandLine, Answer> ParseCommandLine(std::vector<std::string> arguments) {
  CommandLine line;
  CLI::App app(kExamples, "lascaux");
  app.footer(kExitCodes);
  app.set_version_flag("--version", VersionText);
  app.require_subcommand(1);
  CLI::App* build = app.add_subcommand("build", "Turns drawings into models");
  CLI::App* inspect = app.add_subcommand("inspect", "Shows how a drawing was read");
  CLI::App* trace = app.add_subcommand("trace", "Turns the pen strokes of a picture into curves");
  CLI::App* render = app.add_subcommand("render", "Draws pictures of level sets");
  AddBuild(*build, line);
  AddInspect(*inspect, line);
  AddTrace(*trace, line);
  AddRender(*render, line.render, line.threads);
  CLI::App* check = app.add_subcommand("check", "Tells whether a mesh can be printed");
  AddCheck(*check, line);
  try {
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    const auto verbs = app.get_subcommands();
    const CLI::App* asked = verbs.empty() ? &app : verbs.front();
    return Answer{ExitCode::kSuccess, asked->help()};
  } catch (const CLI::CallForVersion&) {
    return Answer{ExitCode::kSuccess, VersionText()};
  } catch (const CLI::ParseError& error) {
    return Answer{ExitCode::kUsage,
                  fmt::format("lascaux: error: usage: {}; lascaux --help shows how\n",
                              Complaint(app, error))};
  }
  line.verb = inspect->parsed()  ? Verb::kInspect
              : trace->parsed()  ? Verb::kTrace
              : render->parsed() ? Verb::kRender
              : check->parsed()  ? Verb::kCheck
                                 : Verb::kBuild;
  return line;
}

}  // namespace lascaux

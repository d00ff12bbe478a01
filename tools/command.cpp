#include "command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "check_command.h"
#include "grid_plugin.h"
#include "lascaux/base/arena.h"
#include "lascaux/io/content_hash.h"
#include "lascaux/io/read_file.h"
#include "overrides.h"
#include "progress.h"
#include "run_together.h"
#include "settle.h"
#include "stopwatch.h"
#include "summary.h"
#include "version.h"

namespace lascaux {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kProgram = "lascaux";

Diagnostic Usage(std::string code, std::string message) {
  return Error(FailureKind::kUsage, std::move(code), std::move(message));
}

/// What can be said about the inputs before any of them is read.
Diagnostics CheckInputs(const CommandOptions& options) {
  Diagnostics errors;
  for (const std::string& sketch : options.sketches) {
    if (sketch == "-" && options.format.empty())
      errors.push_back(
          Usage("unknown-format", "-: standard input has no ending; say --format svg, png or jpg"));
  }
  if (std::count(options.sketches.begin(), options.sketches.end(), "-") > 1)
    errors.push_back(Usage("usage", "-: standard input can be read only once"));
  if (!options.overrides.empty() && options.sketches.size() > 1)
    errors.push_back(Usage("usage",
                           "--overrides: the numbers in it belong to one drawing; build each "
                           "with its own"));
  return errors;
}

/// Would a volume's bytes end on a terminal?
bool ShowsVolume(const std::vector<OutputRequest>& requests) {
  return isatty(STDOUT_FILENO) == 1 &&
         std::any_of(requests.begin(), requests.end(), [](const OutputRequest& request) {
           return request.name == "-" && request.kind == OutputKind::kVdb;
         });
}

/// The formats of -o, and the reports of --report whatever their ending.
Outcome<std::vector<std::vector<OutputTarget>>> Plan(Verb verb, const CommandOptions& options) {
  Diagnostics log;
  auto requests = ReadOutputNames(verb, options.outputs).MoveInto(log);
  if (!requests) return Outcome<std::vector<std::vector<OutputTarget>>>::Failure(std::move(log));
  for (const std::string& name : options.reports) requests->push_back({OutputKind::kReport, name});
  for (const Diagnostic& error : CheckVolume(options.write.volume, *requests)) log.push_back(error);
  if (ShowsVolume(*requests))
    log.push_back(Usage("terminal-output",
                        "-o -: a .vdb is not for a terminal's eyes: send it into a file or another "
                        "program, or name a file"));
  if (HasError(log))
    return Outcome<std::vector<std::vector<OutputTarget>>>::Failure(std::move(log));
  return PlanOutputs(options.sketches, *requests);
}

/// What `lascaux render` needs to show the face; empty when the head is anywhere.
std::vector<std::pair<std::string, std::string>> HeadMetadata(const Model& model) {
  if (!model.graph) return {};
  switch (FindHead(model)) {
    case HeadEnd::kLeft:
      return {{"lascaux_head", "left"}};
    case HeadEnd::kRight:
      return {{"lascaux_head", "right"}};
    case HeadEnd::kUnknown:
      break;
  }
  return {};
}

std::vector<std::pair<std::string, std::string>> Metadata(const std::string& sketch,
                                                          const PipelineOptions& options,
                                                          std::string_view bytes) {
  std::string settings = fmt::format("size={} voxel_size={} blend={}", options.size,
                                     options.VoxelSize(), options.blend);
  if (options.depth.body)
    settings += fmt::format(" body={},{}", options.depth.body->x(), options.depth.body->y());
  return {{"creator", "Lascaux"},
          {"lascaux_version", kVersion},
          {"lascaux_sketch", fs::path(sketch).filename().string()},
          {"lascaux_sketch_hash", ContentHashText(bytes)},
          {"lascaux_options", settings}};
}

/// One sketch of a call.
struct Job {
  std::string sketch;
  std::vector<OutputTarget> targets;
  LastStage last = LastStage::kMesh;
};

/// The last stage that the outputs need.
LastStage LastStageFor(Verb verb, const std::vector<OutputTarget>& targets) {
  if (verb == Verb::kTrace) return LastStage::kSketch;
  if (verb == Verb::kInspect) return LastStage::kCreature;
  // A 3MF file holds a thumbnail.
  const bool picture = std::any_of(targets.begin(), targets.end(), [](const auto& t) {
    return IsPicture(t.kind) || t.kind == OutputKind::k3mf;
  });
  return picture ? LastStage::kPreview : LastStage::kMesh;
}

bool NeedsOpenVdb(const std::vector<OutputTarget>& targets, const CommandOptions& options) {
  RenderOptions render = options.pipeline.preview.render;
  if (HasLayers(targets)) render.layers = Layers::kAll;
  return std::any_of(targets.begin(), targets.end(), [&](const OutputTarget& target) {
    return (IsPicture(target.kind) && NeedsOpenVdb(render)) ||
           (target.kind == OutputKind::kVdb && NeedsOpenVdb(options.write.volume));
  });
}

/// The stages' options, with the file of --overrides if there is one.
Outcome<PipelineOptions> PipelineOptionsOf(const CommandOptions& options) {
  constexpr std::size_t kMostBytes = std::size_t{16} << 20;  // a thousand times what anybody writes
  if (options.overrides.empty()) return options.pipeline;
  Diagnostics log;
  const auto text = ReadBytes(options.overrides, {.max_bytes = kMostBytes}).MoveInto(log);
  if (!text) return Outcome<PipelineOptions>::Failure(std::move(log));
  return WithOverrides(options.pipeline, *text);
}

/// Reads, builds and writes. What went wrong is in the model's diagnostics.
Model Make(const Job& job, const CommandOptions& options, const Execution& execution) {
  Model model;
  model.file = job.sketch;
  Timings reading;
  std::optional<std::string> bytes;
  {
    const Stopwatch watch(reading, "read");
    bytes = ReadBytes(job.sketch, {.max_bytes = options.pipeline.read.max_bytes})
                .MoveInto(model.diagnostics);
  }
  if (!bytes) return model;
  auto pipeline = PipelineOptionsOf(options).MoveInto(model.diagnostics);
  if (!pipeline) return model;
  pipeline->last = job.last;
  if (HasLayers(job.targets)) pipeline->preview.render.layers = Layers::kAll;
  const auto any = [&job](auto&& is) {
    return std::any_of(job.targets.begin(), job.targets.end(),
                       [&is](const auto& target) { return is(target.kind); });
  };
  const auto is_report = [](OutputKind kind) { return kind == OutputKind::kReport; };
  // The summary and the report have the figures, the parse picture the worst place.
  pipeline->compare = options.verbosity != Verbosity::kQuiet || any(is_report) ||
                      any([](OutputKind kind) { return kind == OutputKind::kParsePicture; });
  pipeline->details = any(HoldsDetails) ||
                      pipeline->preview.render.material == Material::kDrawing ||
                      options.write.volume.companions.color;
  pipeline->keep_level_set = NeedsOpenVdb(options.write.volume);
  pipeline->print_warnings = any(IsPrinted);
  pipeline->print_facts = pipeline->print_warnings || any(is_report);
  WriteOptions write = options.write;
  write.name = SketchName(job.sketch);
  write.metadata = Metadata(job.sketch, options.pipeline, *bytes);
  OutputWriter writer(job.targets, execution);
  model = RunPipeline(*bytes, *pipeline, execution, [&](const Model& made, Ready ready) {
    WriteOptions of_model = write;
    for (auto& entry : HeadMetadata(made)) of_model.metadata.push_back(std::move(entry));
    if (write.volume.companions.color && ready == Ready::kMesh)
      of_model.metadata.emplace_back("lascaux_colors", made.colors ? "drawing" : "parts");
    writer.WriteModel(made, ready, of_model);
  });
  model.file = job.sketch;
  model.timings.stages.front().second += reading.stages.front().second;
  model.timings.start = reading.start;

  const ExitCode code = ExitCodeOf(model.diagnostics);
  const bool diagnosed = code == ExitCode::kUnderstanding || code == ExitCode::kMesh;
  if (code == ExitCode::kSuccess || diagnosed) writer.Finish(model, write);
  return model;
}

ExitCode RunJob(const Job& job, const CommandOptions& options, const Execution& execution) {
  const bool quiet = options.verbosity == Verbosity::kQuiet;
  Model model;
  {
    ProgressLine line(quiet ? nullptr : stderr);
    Execution run = execution;
    run.progress = line.Callback(job.sketch);
    RunInArena(run, [&] { model = Make(job, options, run); });
  }
  const ExitCode code = ExitCodeOf(model.diagnostics);
  if (code == ExitCode::kSuccess) model.diagnostics.push_back(Summary(model, job.targets));
  PrintMessages(stderr, job.sketch, model.diagnostics, options.verbosity);
  return code;
}

}  // namespace

ExitCode RunCommand(Verb verb, const CommandOptions& options, const Execution& execution) {
  if (verb == Verb::kCheck) return RunCheck(options, execution);
  Diagnostics errors = CheckInputs(options);
  const auto plan = Plan(verb, options).MoveInto(errors);
  if (!plan || HasError(errors)) {
    PrintMessages(stderr, kProgram, errors, options.verbosity);
    return ExitCode::kUsage;
  }
  // On time for whoever writes a level set or a picture at the end, beside the drawing's reading.
  const auto needs = [&options](const auto& targets) { return NeedsOpenVdb(targets, options); };
  const bool uses_openvdb =
      options.pipeline.print.Any() || std::any_of(plan->begin(), plan->end(), needs);
  if (uses_openvdb) PreloadGridPlugin();
  WakeWorkers(execution);
  ExitCode worst = ExitCode::kSuccess;
  for (std::size_t i = 0; i < options.sketches.size() && !execution.IsCancelled(); ++i) {
    const Job job{options.sketches[i], (*plan)[i], LastStageFor(verb, (*plan)[i])};
    worst = Worse(worst, RunJob(job, options, execution));
  }
  if (!execution.IsCancelled()) return worst;
  if (worst != ExitCode::kInterrupted) {  // between two sketches, or before the first
    PrintMessages(
        stderr, kProgram,
        {Error(FailureKind::kInterrupted, "cancelled", "interrupted; nothing more was written")},
        options.verbosity);
  }
  return Worse(worst, ExitCode::kInterrupted);
}

}  // namespace lascaux

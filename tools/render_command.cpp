#include "render_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "lascaux/io/output_file.h"
#include "lascaux/io/read_file.h"
#include "lascaux/io/read_picture.h"
#include "lascaux/io/read_vdb.h"
#include "lascaux/volume/render_grids.h"
#include "mesh_details_of.h"
#include "output_plan.h"
#include "picture_file.h"
#include "progress.h"

namespace lascaux {
namespace {

constexpr std::string_view kProgram = "lascaux";

Diagnostic Usage(std::string code, std::string message) {
  return Error(FailureKind::kUsage, std::move(code), std::move(message));
}

bool HasPlaceholder(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [](const std::string& name) { return name.find("{}") != std::string::npos; });
}

/// A contact sheet whose name does not depend on the model takes them all.
Sheet SheetOf(const RenderCommandOptions& options) {
  const bool joint =
      options.contact_sheet && options.models.size() > 1 && !HasPlaceholder(options.outputs);
  return joint ? Sheet::kOfAllModels : Sheet::kOfEachModel;
}

/// The formats of the outputs: of their endings, unless one is named.
Outcome<std::vector<OutputRequest>> Requests(const RenderCommandOptions& options) {
  if (options.format.empty()) return ReadOutputNames(Verb::kRender, options.outputs);
  const OutputKind kind = options.format == "exr" ? OutputKind::kExr : OutputKind::kPng;
  std::vector<OutputRequest> requests;
  for (const std::string& name : options.outputs) requests.push_back({kind, name});
  return requests;
}

/// The files of each model; for a sheet of all models each has the same.
Outcome<std::vector<std::vector<OutputTarget>>> Plan(const RenderCommandOptions& options) {
  using Plans = std::vector<std::vector<OutputTarget>>;
  Diagnostics log;
  const auto requests = Requests(options).MoveInto(log);
  if (!requests) return Outcome<Plans>::Failure(std::move(log));
  if (SheetOf(options) == Sheet::kOfEachModel) return PlanOutputs(options.models, *requests);
  Plans plans;
  for (const std::string& model : options.models) {
    auto plan = PlanOutputs({model}, *requests).MoveInto(log);
    if (!plan) return Outcome<Plans>::Failure(std::move(log));
    plans.push_back(std::move(plan->front()));
  }
  return plans;
}

/// What each picture of a model shows, in the order of a sheet: a view's turn after the other's.
std::vector<RenderOptions> Shots(const RenderCommandOptions& options, const RenderOptions& common) {
  std::vector<View> views = options.views;
  if (views.empty() && options.contact_sheet && options.turntable == 0) {
    views = {View::kSide, View::kFront, View::kThreeQuarter, View::kTop};
  }
  if (views.empty()) views = {View::kThreeQuarter};
  std::vector<RenderOptions> shots;
  for (const View view : views) {
    RenderOptions shot = common;
    shot.view = view;
    if (options.turntable > 0) shot.framing = Framing::kTurntable;
    for (int i = 0; i < std::max(1, options.turntable); ++i) {
      if (options.turntable > 0) shot.turn = 360.0 * i / options.turntable;
      shots.push_back(shot);
    }
  }
  return shots;
}

/// Whether bytes are a picture or begin like an SVG file.
bool IsDrawing(std::string_view bytes) {
  constexpr std::size_t kBeginning = 4096;
  return IsPicture(bytes) || bytes.substr(0, kBeginning).find("<svg") != std::string_view::npos;
}

/// What a file says under a name; empty for nothing.
std::string TextOf(const openvdb::MetaMap& metadata, const char* name) {
  const auto text = metadata.getMetadata<openvdb::StringMetadata>(name);
  return text ? text->value() : std::string();
}

/// Where the file says that the head is.
Head HeadOf(const openvdb::MetaMap& metadata) {
  const std::string head = TextOf(metadata, "lascaux_head");
  return head == "left" ? Head::kLeft : head == "right" ? Head::kRight : Head::kHigher;
}

/// The names of the parts, in the order of their numbers.
std::vector<std::string> PartNames(const openvdb::MetaMap& metadata) {
  std::vector<std::string> names;
  std::istringstream list(TextOf(metadata, "lascaux_parts"));
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

/// One call, from the first model to the last file.
class Job {
 public:
  Job(const RenderCommandOptions& options, const Execution& execution)
      : options_(options), execution_(execution) {}

  /// The pictures of a model; what went wrong is in the log.
  std::optional<std::vector<Picture>> Draw(const std::string& name,
                                           const std::vector<OutputTarget>& targets,
                                           Diagnostics& log) const {
    ProgressLine line(options_.verbosity == Verbosity::kQuiet ? nullptr : stderr);
    const auto progress = line.Callback(name);
    if (progress) progress("drawing", 0);
    const auto bytes = ReadBytes(name).MoveInto(log);
    if (!bytes) return std::nullopt;
    RenderOptions common = options_.render;
    if (HasLayers(targets)) common.layers = Layers::kAll;
    if (IsDrawing(*bytes)) {
      log.push_back(Error(FailureKind::kInput, "not-vdb",
                          fmt::format("a drawing, not a level set; 'lascaux build {} -o FILE.png' "
                                      "draws its model",
                                      name)));
      return std::nullopt;
    }
    const bool colors = common.material != Material::kClay || common.layers == Layers::kAll;
    const auto model = ReadVdb(*bytes, {.grid = options_.grid, .colors = colors}).MoveInto(log);
    if (!model) return std::nullopt;
    std::vector<Picture> pictures;
    common.head = HeadOf(model->metadata);
    if (common.material == Material::kDrawing &&
        TextOf(model->metadata, "lascaux_colors") == "parts") {
      log.push_back(Warning("no-colors",
                            "the drawing that this was built from has no colours, the picture "
                            "shows clay; take --material parts"));
      common.material = Material::kClay;
    }
    const ShownModel shown{model->surface, model->color, model->part,
                           PaletteOf(PartNames(model->metadata))};
    for (const RenderOptions& shot : Shots(options_, common)) {
      auto picture = Render(shown, shot, execution_).MoveInto(log);
      if (!picture) return std::nullopt;
      pictures.push_back(*std::move(picture));
    }
    return pictures;
  }

  /// Writes the pictures of one model, or of all; `columns` of a sheet, 0 for about a square.
  void Write(const std::vector<Picture>& pictures, const std::vector<OutputTarget>& targets,
             int columns, Diagnostics& log) const {
    OutputSet files;
    std::string wrote;
    for (const OutputTarget& target : targets) {
      for (const PictureFile& file : PicturesOf(pictures, target, columns)) {
        const auto path = files.Add(file.path).MoveInto(log);
        if (!path) return;
        const Diagnostics errors =
            InNameOf(file.path, *path, WritePicture(*path, file.picture, target.kind));
        log.insert(log.end(), errors.begin(), errors.end());
        if (HasError(errors)) return;
      }
      wrote += (wrote.empty() ? "" : ", ") + target.path.string();
    }
    const Diagnostics errors = files.Commit();
    log.insert(log.end(), errors.begin(), errors.end());
    if (HasError(errors)) return;
    log.push_back(
        Note("rendered", fmt::format("{} picture{} of {} x {} pixels; wrote {}", pictures.size(),
                                     pictures.size() == 1 ? "" : "s", options_.render.width,
                                     options_.render.height, wrote)));
  }

  ExitCode Say(const std::string& name, const Diagnostics& log) const {
    PrintMessages(stderr, name, log, options_.verbosity);
    return ExitCodeOf(log);
  }

 private:
  const RenderCommandOptions& options_;
  const Execution& execution_;
};

ExitCode DrawEach(const Job& job, const RenderCommandOptions& options,
                  const std::vector<std::vector<OutputTarget>>& plan, const Execution& execution) {
  ExitCode worst = ExitCode::kSuccess;
  for (std::size_t i = 0; i < options.models.size() && !execution.IsCancelled(); ++i) {
    Diagnostics log;
    if (const auto pictures = job.Draw(options.models[i], plan[i], log))
      job.Write(*pictures, plan[i], options.columns, log);
    worst = Worse(worst, job.Say(options.models[i], log));
  }
  return worst;
}

/// All or nothing: a sheet with a hole in it would be taken for a sheet of what there is.
ExitCode DrawAll(const Job& job, const RenderCommandOptions& options,
                 const std::vector<OutputTarget>& targets, const Execution& execution) {
  ExitCode worst = ExitCode::kSuccess;
  std::vector<Picture> all;
  for (std::size_t i = 0; i < options.models.size() && !execution.IsCancelled(); ++i) {
    Diagnostics log;
    if (auto pictures = job.Draw(options.models[i], targets, log)) {
      std::move(pictures->begin(), pictures->end(), std::back_inserter(all));
    }
    worst = Worse(worst, job.Say(options.models[i], log));
  }
  if (worst != ExitCode::kSuccess || execution.IsCancelled()) return worst;
  Diagnostics log;
  // A row for each model that has several pictures.
  const std::size_t each = all.size() / options.models.size();
  const int columns = options.columns > 0 || each == 1 ? options.columns : static_cast<int>(each);
  job.Write(all, targets, columns, log);
  return job.Say(std::string(kProgram), log);
}

}  // namespace

ExitCode RunRender(const RenderCommandOptions& options, const Execution& execution) {
  Diagnostics errors;
  if (std::count(options.models.begin(), options.models.end(), "-") > 1) {
    errors.push_back(Usage("usage", "-: standard input can be read only once"));
  }
  const auto plan = Plan(options).MoveInto(errors);
  if (!plan || HasError(errors)) {
    PrintMessages(stderr, kProgram, errors, options.verbosity);
    return ExitCode::kUsage;
  }
  const Job job(options, execution);
  const ExitCode worst = SheetOf(options) == Sheet::kOfAllModels
                             ? DrawAll(job, options, plan->front(), execution)
                             : DrawEach(job, options, *plan, execution);
  return execution.IsCancelled() ? Worse(worst, ExitCode::kInterrupted) : worst;
}

}  // namespace lascaux

#include "write_outputs.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "curves_file.h"
#include "grid.h"
#include "grid_plugin.h"
#include "lascaux/io/output_file.h"
#include "lascaux/io/write_ply.h"
#include "lascaux/io/write_stl.h"
#include "parse_dump.h"
#include "parse_picture.h"
#include "picture_file.h"
#include "stopwatch.h"

namespace lascaux {
namespace {

Diagnostics WriteBand(const std::filesystem::path& path, const NarrowBand& band,
                      const WriteVdbOptions& options, const Execution& execution) {
  const auto& plugin = LoadGridPlugin();
  return plugin ? (*plugin)->write_vdb(path, band, options, execution) : plugin.diagnostics();
}

Diagnostics Write(const Model& model, OutputKind kind, const std::filesystem::path& path,
                  const WriteOptions& options, const Execution& execution) {
  switch (kind) {
    case OutputKind::kVdb:
      return WriteBand(path, model.grid->surface,
                       {.unit = options.unit, .metadata = options.metadata}, execution);
    case OutputKind::kStl:
      return WriteStl(path, *model.mesh);
    case OutputKind::kPly:
      return WritePly(path, *model.mesh, {.unit = options.unit});
    case OutputKind::kPng:
    case OutputKind::kExr:
      return WritePicture(path, *model.preview, kind);
    case OutputKind::kParsePicture:
      return WriteBytes(path, ParsePictureText(model));
    case OutputKind::kParseDump:
      return WriteBytes(path, ParseDumpText(model));
    case OutputKind::kCurves:
      return WriteBytes(path, CurvesText(model));
    case OutputKind::kTraceFacts:
      return WriteBytes(path, TraceFactsText(model));
    case OutputKind::kReport:
      break;
  }
  return WriteBytes(path, ReportText(model, options.timings));
}

/// Moves diagnostics into the model; false when one of them is an error.
bool Log(Diagnostics found, Model& model) {
  const bool good = !HasError(found);
  model.diagnostics.insert(model.diagnostics.end(), std::make_move_iterator(found.begin()),
                           std::make_move_iterator(found.end()));
  return good;
}

bool Interrupted(const Execution& execution, Model& model) {
  if (!execution.IsCancelled()) return false;
  return !Log({Error(FailureKind::kInterrupted, "cancelled", "interrupted; nothing was written")},
              model);
}

}  // namespace

void WriteOutputs(Model& model, const std::vector<OutputTarget>& targets,
                  const WriteOptions& options, const Execution& execution) {
  const bool failed = HasError(model.diagnostics);
  OutputSet files;
  const auto write = [&](const OutputTarget& target) {
    auto path = files.Add(target.path).MoveInto(model.diagnostics);
    return path && Log(Write(model, target.kind, *path, options, execution), model) &&
           !Interrupted(execution, model);
  };
  const auto is_report = [](const OutputTarget& t) { return t.kind == OutputKind::kReport; };
  {
    const Stopwatch watch(model.timings, "write");
    for (const OutputTarget& target : targets)
      if (!is_report(target) && !(failed && IsModel(target.kind)) && !write(target)) return;
  }
  for (const auto& [stage, milliseconds] : model.timings.stages)
    model.timings.total += milliseconds;
  for (const OutputTarget& target : targets)  // last: they hold what the others had to say
    if (is_report(target) && !write(target)) return;
  Log(files.Commit(), model);
}

}  // namespace lascaux

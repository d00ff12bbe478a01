#include "write_outputs.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "curves_file.h"
#include "grid.h"
#include "lascaux/io/output_file.h"
#include "lascaux/io/write_3mf.h"
#include "lascaux/io/write_band_vdb.h"
#include "lascaux/io/write_glb.h"
#include "lascaux/io/write_obj.h"
#include "lascaux/io/write_ply.h"
#include "lascaux/io/write_stl.h"
#include "lascaux/io/write_usda.h"
#include "parse_dump.h"
#include "parse_picture.h"
#include "picture_file.h"
#include "stopwatch.h"

namespace lascaux {
namespace {

namespace fs = std::filesystem;

/// The .vdb among the targets as it is called from the folder of `from`; empty when there is none.
std::string VolumeBeside(const std::vector<OutputTarget>& targets, const fs::path& from) {
  const auto vdb = std::find_if(targets.begin(), targets.end(),
                                [](const auto& t) { return t.kind == OutputKind::kVdb; });
  if (vdb == targets.end()) return {};
  const fs::path folder = fs::absolute(from).parent_path();
  const std::string path = fs::absolute(vdb->path).lexically_relative(folder).generic_string();
  return path.starts_with("..") ? path : "./" + path;
}

/// The writers of a run's files.
struct Writer {
  const Model& model;
  const std::vector<OutputTarget>& targets;
  const WriteOptions& options;
  const Execution& execution;

  /// Writes `target` to `path`, its stand-in.
  Diagnostics Write(const OutputTarget& target, const fs::path& path) const {
    switch (target.kind) {
      case OutputKind::kVdb:
        return WriteBandVdb(path, model.grid->surface,
                            {.unit = options.unit, .metadata = options.metadata});
      case OutputKind::kPng:
      case OutputKind::kExr:
        return WritePicture(path, *model.preview, target.kind);
      case OutputKind::kParsePicture:
        return WriteBytes(path, ParsePictureText(model));
      case OutputKind::kParseDump:
        return WriteBytes(path, ParseDumpText(model));
      case OutputKind::kCurves:
        return WriteBytes(path, CurvesText(model));
      case OutputKind::kTraceFacts:
        return WriteBytes(path, TraceFactsText(model));
      case OutputKind::kReport:
        return WriteBytes(path, ReportText(model, options.timings));
      default:
        return WriteMesh(target, path);
    }
  }

 private:
  Diagnostics WriteMesh(const OutputTarget& target, const fs::path& path) const {
    const MeshFileOptions file{options.unit, options.name, options.metadata};
    switch (target.kind) {
      case OutputKind::k3mf:
        return Write3mf(path, *model.mesh, *model.details, {file, ToImage(*model.preview)});
      case OutputKind::kGlb:
        return WriteGlb(path, *model.mesh, *model.details, file);
      case OutputKind::kObj:
        return WriteObj(path, *model.mesh, *model.details, file);
      case OutputKind::kPly:
        return WritePly(path, *model.mesh, *model.details, file);
      case OutputKind::kUsda:
        return WriteUsda(path, *model.mesh, *model.details,
                         {file, VolumeBeside(targets, target.path)});
      default:
        return WriteStl(path, *model.mesh);
    }
  }
};

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
  const Writer writer{model, targets, options, execution};
  OutputSet files;
  const auto write = [&](const OutputTarget& target) {
    auto path = files.Add(target.path).MoveInto(model.diagnostics);
    return path && Log(writer.Write(target, *path), model) && !Interrupted(execution, model);
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

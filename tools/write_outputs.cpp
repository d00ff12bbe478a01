#include "write_outputs.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include "curves_file.h"
#include "grid.h"
#include "grid_plugin.h"
#include "lascaux/io/output_file.h"
#include "lascaux/io/stream_file.h"
#include "lascaux/io/write_3mf.h"
#include "lascaux/io/write_band_vdb.h"
#include "lascaux/io/write_glb.h"
#include "lascaux/io/write_obj.h"
#include "lascaux/io/write_ply.h"
#include "lascaux/io/write_stl.h"
#include "lascaux/io/write_usda.h"
#include "mesh_details_of.h"
#include "parse_dump.h"
#include "parse_picture.h"
#include "picture_file.h"
#include "run_together.h"
#include "stopwatch.h"

namespace lascaux {
namespace {

namespace fs = std::filesystem;

/// The .vdb among the targets as it is called from the folder of `from`; empty when there is none.
std::string VolumeBeside(const std::vector<OutputTarget>& targets, const fs::path& from) {
  const auto vdb = std::find_if(targets.begin(), targets.end(), [](const auto& t) {
    return t.kind == OutputKind::kVdb && !IsStandardOutput(t);
  });
  if (vdb == targets.end()) return {};
  const fs::path folder = fs::absolute(from).parent_path();
  const std::string path = fs::absolute(vdb->path).lexically_relative(folder).generic_string();
  return path.starts_with("..") ? path : "./" + path;
}

/// "body,limb-1,limb-1-far": the index of a name is the number of the part.
std::string NamesOf(const std::vector<MeshPart>& parts) {
  std::string names;
  for (const MeshPart& part : parts) names += (names.empty() ? "" : ",") + part.name;
  return names;
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
        return WriteVolume(path);
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
  UsdaOptions StageOptions(const OutputTarget& target, const MeshFileOptions& file) const {
    UsdaOptions stage{file};
    stage.volume = VolumeBeside(targets, target.path);
    stage.volume_up = options.volume.up;
    if (options.volume.companions.fog) stage.fog = true;
    return stage;
  }

  Diagnostics WriteVolume(const fs::path& path) const {
    const VolumeOptions& volume = options.volume;
    const std::vector<MeshPart> parts = FieldPartsOf(model);
    WriteVdbOptions file{options.unit, volume.up, volume.floats, options.metadata};
    file.metadata.emplace_back("lascaux_parts", NamesOf(parts));
    if (!NeedsOpenVdb(volume)) {
      const NarrowBand& surface = model.grid->surface;
      if (volume.up == UpAxis::kZ) return WriteBandVdb(path, TurnedZUp(surface), file);
      return WriteBandVdb(path, surface, file);
    }
    const ModelVolume contents{model.grid->surface,
                               *model.field,
                               parts,
                               model.lift,
                               volume.companions,
                               volume.up,
                               model.colors ? &*model.colors : nullptr};
    const auto& plugin = LoadGridPlugin();
    return plugin ? (*plugin)->write_vdb(path, contents, file, execution) : plugin.diagnostics();
  }

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
        return WriteUsda(path, *model.mesh, *model.details, StageOptions(target, file));
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
  std::optional<StreamFile> stream;
  const auto add = [&](const OutputTarget& target) {
    return IsStandardOutput(target) ? stream.emplace().path() : files.Add(target.path);
  };
  const auto is_report = [](const OutputTarget& t) { return t.kind == OutputKind::kReport; };
  // Side by side; what they say, in order.
  const auto write = [&](const std::vector<OutputTarget>& chosen) {
    std::vector<fs::path> paths;
    for (const OutputTarget& target : chosen) {
      auto path = add(target).MoveInto(model.diagnostics);
      if (!path) return false;
      paths.push_back(std::move(*path));
    }
    std::vector<Diagnostics> found(chosen.size());
    ForEachTogether(execution, chosen.size(),
                    [&](std::size_t i) { found[i] = writer.Write(chosen[i], paths[i]); });
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (!Log(InNameOf(chosen[i].path, paths[i], std::move(found[i])), model)) return false;
    return !Interrupted(execution, model);
  };
  std::vector<OutputTarget> files_of_model, reports;
  for (const OutputTarget& target : targets) {
    if (is_report(target))
      reports.push_back(target);
    else if (!(failed && IsModel(target.kind)))
      files_of_model.push_back(target);
  }
  {
    const Stopwatch watch(model.timings, "write");
    if (!write(files_of_model)) return;
  }
  model.timings.total = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() -
                                                                  model.timings.start)
                            .count();
  if (!write(reports)) return;  // last: they hold what the others had to say
  // First what may fail with somebody else: files that appear can't be told from those of a
  // success.
  if (stream && !Log(stream->SendTo(STDOUT_FILENO), model)) return;
  Log(files.Commit(), model);
}

}  // namespace lascaux

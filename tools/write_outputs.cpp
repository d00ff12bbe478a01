#include "write_outputs.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <utility>

#include "curves_file.h"
#include "grid.h"
#include "grid_plugin.h"
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
std::string Joined(const std::vector<std::string>& names) {
  std::string joined;
  for (const std::string& name : names) joined += (joined.empty() ? "" : ",") + name;
  return joined;
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
    WriteVdbOptions file{options.unit, volume.up, volume.floats, options.metadata};
    file.metadata.emplace_back("lascaux_parts", Joined(FieldPartNamesOf(model)));
    if (!NeedsOpenVdb(volume)) {
      const NarrowBand& surface = model.grid->surface;
      if (volume.up == UpAxis::kZ) return WriteBandVdb(path, TurnedZUp(surface), file);
      return WriteBandVdb(path, surface, file);
    }
    const std::vector<MeshPart> parts = FieldPartsOf(model);
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

void Append(Diagnostics found, Diagnostics& log) {
  std::move(found.begin(), found.end(), std::back_inserter(log));
}

}  // namespace

template <typename Is>
OutputWriter::Numbered OutputWriter::Chosen(const Is& is) const {
  Numbered chosen;
  for (std::size_t i = 0; i < targets_.size(); ++i)
    if (is(targets_[i].kind)) chosen.push_back(i);
  return chosen;
}

/// The stand-in of a target.
Outcome<fs::path> OutputWriter::Add(const OutputTarget& target) {
  const std::lock_guard lock(adding_);
  return IsStandardOutput(target) ? stream_.emplace().path() : files_.Add(target.path);
}

void OutputWriter::Write(const Model& model, const WriteOptions& options, const Numbered& chosen) {
  const auto start = std::chrono::steady_clock::now();
  const Writer writer{model, targets_, options, execution_};
  ForEachTogether(execution_, chosen.size(), [&](std::size_t k) {
    const OutputTarget& target = targets_[chosen[k]];
    Diagnostics& found = found_[chosen[k]];
    if (const auto path = Add(target).MoveInto(found))
      Append(InNameOf(target.path, *path, writer.Write(target, *path)), found);
  });
  writing_ += MillisecondsSince(start);
}

/// What was found since the last call, in the targets' order up to the first error: a full disk is
/// one.
Diagnostics OutputWriter::TakeLog() {
  Diagnostics log;
  for (Diagnostics& found : found_) {
    if (!HasError(log)) Append(std::move(found), log);
    found.clear();
  }
  return log;
}

void OutputWriter::WriteModel(const Model& model, Ready ready, const WriteOptions& options) {
  const auto needed = [&](OutputKind kind) {
    if (kind == OutputKind::k3mf) return Ready::kAll;  // it holds a thumbnail
    if (IsPicture(kind)) return Ready::kPreview;
    // More grids than the surface may show the drawing's colours, which come with the details.
    const bool alone = kind == OutputKind::kVdb && !NeedsOpenVdb(options.volume);
    return alone ? Ready::kLevelSet : Ready::kMesh;
  };
  Write(model, options,
        Chosen([&](OutputKind kind) { return IsModel(kind) && needed(kind) == ready; }));
}

void OutputWriter::Finish(Model& model, const WriteOptions& options) {
  const auto is_report = [](OutputKind kind) { return kind == OutputKind::kReport; };
  if (HasError(model.diagnostics)) {  // nobody is to see the model's files
    files_ = {};
    stream_.reset();
    TakeLog();
  }
  const auto go_on = [&] {
    Diagnostics log = TakeLog();
    if (!HasError(log) && execution_.IsCancelled()) {
      log.push_back(
          Error(FailureKind::kInterrupted, "cancelled", "interrupted; nothing was written"));
    }
    const bool good = !HasError(log);
    Append(std::move(log), model.diagnostics);
    return good;
  };
  Write(model, options,
        Chosen([&](OutputKind kind) { return !IsModel(kind) && !is_report(kind); }));
  model.timings.stages.emplace_back("write", writing_);
  model.timings.total = MillisecondsSince(model.timings.start);
  if (!go_on()) return;
  Write(model, options, Chosen(is_report));  // last: they hold what the others had to say
  if (!go_on()) return;
  // First what may fail with somebody else: files that appear can't be told from those of a
  // success.
  if (stream_) {
    Diagnostics sent = stream_->SendTo(STDOUT_FILENO);
    const bool good = !HasError(sent);
    Append(std::move(sent), model.diagnostics);
    if (!good) return;
  }
  Append(files_.Commit(), model.diagnostics);
}

}  // namespace lascaux

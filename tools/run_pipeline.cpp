#include "run_pipeline.h"

#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <functional>
#include <iterator>
#include <memory>
#include <new>
#include <utility>

#include "give_back_memory.h"
#include "grid.h"
#include "grid_plugin.h"
#include "lascaux/skeleton/normalise_outline.h"
#include "lascaux/volume/extract_mesh.h"
#include "lascaux/volume/narrow_band.h"
#include "lascaux/volume/render.h"
#include "lascaux/volume/simplify.h"
#include "mesh_details_of.h"
#include "record_print.h"
#include "run_together.h"
#include "settle.h"
#include "stopwatch.h"

namespace lascaux {
namespace {

Diagnostic NoColors() {
  return Warning("no-colors",
                 "the drawing has no colours, the picture shows clay; fill the drawing's areas, or "
                 "take --material parts");
}

/// A run: each step returns false when the run is over.
class Run {
 public:
  Run(std::string_view bytes, const PipelineOptions& options, const Execution& execution,
      const std::function<void(const Model&, Ready)>& beside_check)
      : bytes_(bytes), options_(options), execution_(execution), beside_check_(beside_check) {}

  void Go() {
    if (!Read() || options_.last == LastStage::kSketch) return;
    const bool understood = Understand() && ExtractSkeleton() && Fit();
    if (!understood || options_.last == LastStage::kCreature) return;
    if (!MakeVolume() || !MakeMesh() || !PrepareForPrint() || !TakeFewerFaces()) return;
    Settle();
    if (Check() && options_.print_warnings) WarnOfPrint();
  }

  Model& model() { return model_; }

 private:
  /// Moves a stage's value and diagnostics into the model. False on an error, and when somebody
  /// asked to stop.
  template <typename T, typename Target>
  bool Keep(Outcome<T> outcome, Target& target) {
    std::optional<T> value = std::move(outcome).MoveInto(model_.diagnostics);
    if (!value) return false;
    target = std::move(*value);
    return Continue();
  }

  bool Continue() {
    if (!execution_.IsCancelled()) return true;
    model_.diagnostics.push_back(
        Error(FailureKind::kInterrupted, "cancelled", "interrupted; nothing was written"));
    return false;
  }

  bool Read() {
    const Stopwatch watch(model_.timings, "read");
    execution_.Report("reading", 0);
    return IsPicture(bytes_) ? Trace() : Keep(ReadSvg(bytes_, options_.read), model_.sketch);
  }

  bool Trace() {
    std::optional<Bitmap> picture;
    if (!Keep(ReadPicture(bytes_, options_.picture), picture)) return false;
    std::optional<TracedPicture> traced;
    if (!Keep(TracePicture(*picture, options_.trace, execution_), traced)) return false;
    model_.sketch = std::move(traced->sketch);
    model_.trace = traced->facts;
    if (options_.details) model_.picture = std::move(picture);
    return true;
  }

  bool Understand() {
    const Stopwatch watch(model_.timings, "structure");
    execution_.Report("understanding", 0);
    return Keep(BuildPlanarMap(*model_.sketch, options_.map, execution_), model_.map) &&
           Keep(FindParts(*model_.map, options_.parts, execution_), model_.parts) &&
           Keep(OrderByDepth(*model_.map, *model_.parts, options_.depth, execution_), model_.graph);
  }

  bool ExtractSkeleton() {
    const Stopwatch watch(model_.timings, "skeleton");
    execution_.Report("finding the skeleton", 0);
    if (!Keep(ExtractSkeletons(*model_.parts, *model_.graph, options_.skeletons, execution_),
              model_.skeletons))
      return false;
    model_.creature = AssembleCreature(*model_.graph, *model_.skeletons);
    return true;
  }

  bool Fit() {
    if (options_.outline_fit != OutlineFit::kNone) {
      const Stopwatch watch(model_.timings, "fit");
      execution_.Report("fitting it to the drawing", 0);
      if (!Keep(FitToDrawing(*model_.parts, *model_.creature, options_.fit, execution_),
                model_.creature))
        return false;
    }
    return Place();
  }

  bool Place() {
    const Stopwatch watch(model_.timings, "depth");
    execution_.Report("placing it in depth", 0);
    return Keep(PlaceInDepth(*model_.parts, *model_.graph, *model_.creature, options_.placement),
                model_.creature);
  }

  bool MakeVolume() {
    {
      const Stopwatch watch(model_.timings, "field");
      execution_.Report("building the field", 0);
      model_.frame = FrameOf(*model_.parts, *model_.graph, options_.size);
      model_.field = MakeField(*model_.creature, *model_.frame, options_.blend);
      if (options_.outline_fit == OutlineFit::kExact) {
        const DrawnOutline drawn{*model_.parts, *model_.graph, *model_.frame};
        model_.field = NormaliseOutline(std::move(*model_.field), drawn, execution_);
      }
    }
    const Stopwatch watch(model_.timings, "volume");
    execution_.Report("filling the volume", 0);
    auto grid = std::make_shared<Grid>();
    if (!Keep(RasteriseBand(*model_.field, {.voxel_size = options_.VoxelSize()}, execution_),
              grid->surface))
      return false;
    model_.grid_facts = FactsOf(grid->surface);
    model_.grid = std::move(grid);
    GiveBackFromLarge();
    return true;
  }

  /// What stages give back is kept for the next. Of a large model it would add to the memory that
  /// is needed most.
  void GiveBackFromLarge() const {
    constexpr std::int64_t kLarge = std::int64_t{32} << 20;  // bytes
    if (model_.grid_facts->bytes > kLarge) GiveBackMemory();
  }

  bool MakeMesh() {
    const Stopwatch watch(model_.timings, "mesh");
    execution_.Report("extracting the mesh", 0);
    if (!Keep(ExtractMesh(model_.grid->surface, *model_.field, execution_), model_.mesh))
      return false;
    GiveBackFromLarge();
    return true;
  }

  bool PrepareForPrint() {
    if (!options_.print.Any()) return true;
    const Stopwatch watch(model_.timings, "print");
    execution_.Report("preparing it for printing", 0);
    const auto& plugin = LoadGridPlugin();
    std::optional<PreparedPrint> prepared;
    if (!(plugin ? Keep((*plugin)->prepare_print(model_.grid->surface, *model_.mesh, options_.print,
                                                 execution_),
                        prepared)
                 : Keep(Outcome<PreparedPrint>::Failure(plugin.diagnostics()), prepared)))
      return false;
    model_.print_record = RecordOf(std::move(prepared->changes), model_, execution_);
    const PrintChanges& changes = model_.print_record->changes;
    if (changes.thickened.empty() && !changes.plate && !changes.cavity) return true;
    model_.grid->surface = std::move(prepared->band);
    model_.grid_facts = FactsOf(model_.grid->surface);
    return Keep(ExtractMesh(model_.grid->surface, *model_.field, prepared->unchanged, execution_),
                model_.mesh);
  }

  bool TakeFewerFaces() {
    if (!options_.faces) return true;
    const Stopwatch watch(model_.timings, "simplify");
    execution_.Report("collapsing edges", 0);
    return Keep(Simplify(*model_.mesh, *options_.faces, execution_), model_.mesh);
  }

  void Settle() {
    StandOnGround(model_);
    if (model_.print_record) Log(DescribeChanges(*model_.print_record, options_.print));
  }

  void Log(Diagnostics found) {
    std::move(found.begin(), found.end(), std::back_inserter(model_.diagnostics));
  }

  /// Checks the mesh; beside that, all that is made of it.
  bool Check() {
    execution_.Report("checking the mesh", 0);
    Timings check, others, preview;
    Diagnostics log;
    MeshFacts facts;  // of no concern to the others
    const Lattice lattice = LatticeOf(model_.grid->surface);
    const auto check_mesh = [&] {
      // First, for it is large, and often nobody needs it any more.
      LeaveLevelSet();
      const Stopwatch watch(check, "check");
      facts = options_.faces ? CheckMesh(*model_.mesh, execution_)
                             : CheckMesh(*model_.mesh, lattice, execution_);
    };
    // Clay needs no details. Files of a mesh take long and are written by one thread: not last.
    const bool is_apart = !NeedsOpenVdb(options_.preview.render);
    RunTogether(
        execution_,
        [&] {
          if (is_apart) MakePreview(preview, log);
        },
        check_mesh,
        [&] {
          MakeDetails(others);
          if (!is_apart) MakePreview(preview, log);
        });
    model_.facts = facts;
    for (const Timings& timings : {check, others, preview})
      for (const auto& stage : timings.stages) model_.timings.stages.push_back(stage);
    if (!Continue()) return false;
    Log(MeshDefects(facts));
    if (HasError(model_.diagnostics)) return false;
    Log(std::move(log));
    return !HasError(model_.diagnostics);
  }

  void LeaveLevelSet() {
    Tell(Ready::kLevelSet);
    if (!options_.keep_level_set && options_.last != LastStage::kPreview) model_.grid.reset();
  }

  /// All that is said of the mesh, and the files that hold it.
  void MakeDetails(Timings& timings) {
    if (options_.compare) Compare(timings);
    if (options_.details || options_.print_facts) AddDetails(timings);
    if (options_.print_facts) MeasurePrint(timings);
    Tell(Ready::kMesh);
  }

  void MakePreview(Timings& timings, Diagnostics& log) {
    if (options_.last != LastStage::kPreview) return;
    RenderPreview(timings, log);
    if (model_.preview) Tell(Ready::kPreview);
  }

  void Tell(Ready ready) {
    if (!beside_check_ || execution_.IsCancelled()) return;
    beside_check_(model_, ready);
    if (++told_ == 3) beside_check_(model_, Ready::kAll);
  }

  void Compare(Timings& timings) {
    const Stopwatch watch(timings, "fidelity");
    model_.fidelity = MeasureFidelity(*model_.mesh, BuiltOutlines(model_), execution_);
  }

  void AddDetails(Timings& timings) {
    const Stopwatch watch(timings, "details");
    model_.details = MeshDetailsOf(model_, execution_);
    model_.colors = DrawingColorsOf(model_, execution_);
    if (model_.colors) Paint(*model_.colors, *model_.mesh, *model_.details);
  }

  void MeasurePrint(Timings& timings) {
    const Stopwatch watch(timings, "walls");
    model_.print = MeasureForPrint(*model_.mesh, *model_.details, 1, execution_);
  }

  void WarnOfPrint() {
    for (Diagnostic& warning : PrintWarnings(*model_.print))
      model_.diagnostics.push_back(std::move(warning));
  }

  void RenderPreview(Timings& timings, Diagnostics& log) {
    const Stopwatch watch(timings, "render");
    RenderOptions options = options_.preview.render;
    const HeadEnd head = FindHead(model_);
    if (head == HeadEnd::kRight) options.head = Head::kRight;
    if (head == HeadEnd::kLeft) options.head = Head::kLeft;
    if (options.material == Material::kDrawing && !model_.colors) {
      log.push_back(NoColors());
      options.material = Material::kClay;
    }
    std::vector<RenderOptions> shots;
    for (const View view : options_.preview.views) shots.emplace_back(options).view = view;
    auto pictures = (NeedsOpenVdb(options) ? DrawGrids(shots) : DrawClay(shots)).MoveInto(log);
    if (!pictures) return;
    const int columns = SheetColumns(static_cast<int>(pictures->size()));
    model_.preview =
        pictures->size() == 1 ? std::move((*pictures)[0]) : ArrangePictures(*pictures, columns);
  }

  Outcome<std::vector<Picture>> DrawClay(const std::vector<RenderOptions>& shots) {
    std::vector<Picture> pictures;
    Diagnostics log;
    for (const RenderOptions& shot : shots) {
      auto picture = Render(model_.grid->surface, shot, execution_).MoveInto(log);
      if (!picture) return Outcome<std::vector<Picture>>::Failure(std::move(log));
      pictures.push_back(std::move(*picture));
    }
    return {std::move(pictures), std::move(log)};
  }

  Outcome<std::vector<Picture>> DrawGrids(const std::vector<RenderOptions>& shots) {
    const auto& plugin = LoadGridPlugin();
    if (!plugin) return Outcome<std::vector<Picture>>::Failure(plugin.diagnostics());
    const std::vector<MeshPart> parts = FieldPartsOf(model_);
    const ModelVolume volume{model_.grid->surface,
                             *model_.field,
                             parts,
                             model_.lift,
                             {},
                             UpAxis::kY,
                             model_.colors ? &*model_.colors : nullptr};
    return (*plugin)->render(volume, PaletteOf(FieldPartNamesOf(model_)), shots, execution_);
  }

  std::string_view bytes_;
  const PipelineOptions& options_;
  const Execution& execution_;
  const std::function<void(const Model&, Ready)>& beside_check_;
  std::atomic<int> told_ = 0;
  Model model_;
};

Diagnostic OutOfMemory(const Model& model, const PipelineOptions& options) {
  std::string need = "more memory than there is";
  if (model.field) {
    const std::size_t bytes = EstimateBytes(*model.field, {.voxel_size = options.VoxelSize()});
    need = fmt::format("about {:.1f} GB of memory, more than there is",
                       static_cast<double>(bytes) / 1e9);
  }
  return Error(FailureKind::kUsage, "out-of-memory",
               fmt::format("voxels of {:.3g} mm need {}; take a lower --resolution",
                           options.VoxelSize(), need));
}

}  // namespace

Model RunPipeline(std::string_view bytes, const PipelineOptions& options,
                  const Execution& execution,
                  const std::function<void(const Model&, Ready)>& beside_check) {
  Run run(bytes, options, execution, beside_check);
  try {
    run.Go();
  } catch (const std::bad_alloc&) {
    run.model().diagnostics.push_back(OutOfMemory(run.model(), options));
  } catch (const std::exception& error) {
    run.model().diagnostics.push_back(
        Error(FailureKind::kBug, "internal-error",
              fmt::format("{}; this is a bug, please report it with the drawing", error.what())));
  }
  return std::move(run.model());
}

}  // namespace lascaux

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/io/read_picture.h"
#include "lascaux/skeleton/fit.h"
#include "lascaux/sketch/read_svg.h"
#include "lascaux/sketch/trace_picture.h"
#include "lascaux/volume/print_options.h"
#include "lascaux/volume/render_options.h"
#include "model.h"

namespace lascaux {

/// How far to go.
enum class LastStage : std::uint8_t {
  kSketch,    ///< the drawing is read, a picture traced
  kCreature,  ///< the drawing is understood: parts, depth, skeletons
  kMesh,      ///< the model is built and measured
  kPreview,   ///< and a picture of it is rendered
};

/// What of a model may be read while it is being checked.
enum class Ready : std::uint8_t {
  kLevelSet,  ///< the level set, before all others; details and colours may be in the making
  kMesh,      ///< the mesh with its details
  kPreview,   ///< the preview
  kAll,       ///< all of it
};

/// How the model meets the drawing's outline.
enum class OutlineFit {
  kNone,   ///< discs of the medial axis as they are: raw SCALIS with caps
  kExact,  ///< fitted, and what the fit leaves normalised away
};

/// The picture that a build makes of its model: several views share a sheet.
struct PreviewOptions {
  std::vector<View> views = {View::kThreeQuarter};
  RenderOptions render;  ///< of each view; the head is where the eyes are
};

/// True for pictures that show more than clay: colours and parts come as OpenVDB's grids.
inline bool NeedsOpenVdb(const RenderOptions& options) noexcept {
  return options.material != Material::kClay || options.layers == Layers::kAll;
}

/// The options of every stage, and what no single stage owns.
struct PipelineOptions {
  ReadSvgOptions read;
  ReadPictureOptions picture;
  TracePictureOptions trace;
  BuildPlanarMapOptions map;
  FindPartsOptions parts;
  OrderByDepthOptions depth;
  ExtractSkeletonsOptions skeletons;
  PlaceInDepthOptions placement;
  FitOptions fit;
  OutlineFit outline_fit = OutlineFit::kExact;
  double blend = 4;                  ///< Ricci exponent between a part and its parent
  double size = 100;                 ///< longest side of the model, mm
  int resolution = 256;              ///< voxels along the longest side
  std::optional<double> voxel_size;  ///< mm; decides instead of the resolution
  PrintOptions print;
  std::optional<std::size_t> faces;  ///< triangles that the mesh may have
  bool keep_level_set = true;        ///< once Ready::kLevelSet was told of and no stage needs it
  PreviewOptions preview;
  LastStage last = LastStage::kMesh;
  bool compare = true;          ///< the mesh with the drawing
  bool details = false;         ///< normals, parts and colours of the mesh, for what shows them
  bool print_facts = false;     ///< walls and stability, for the report
  bool print_warnings = false;  ///< and warnings of what does not print well

  /// Edge of a voxel, mm.
  double VoxelSize() const { return voxel_size.value_or(size / resolution); }
};

/// Takes the bytes of a drawing, an SVG document or a picture, through the stages. Stops at the
/// first error and keeps what was found until then; the diagnostics say what happened. Never
/// throws: memory that runs out is the error "out-of-memory", anything else that a library throws
/// is "internal-error".
///
/// A mesh that is not printable is an error "mesh-not-printable" and stays in the model with its
/// facts.
///
/// `beside_check` is called while the mesh is checked, which may still find an error: the time to
/// write files. It is called once for each Ready that the run comes to, some side by side.
Model RunPipeline(std::string_view bytes, const PipelineOptions& options,
                  const Execution& execution = {},
                  const std::function<void(const Model&, Ready)>& beside_check = {});

}  // namespace lascaux

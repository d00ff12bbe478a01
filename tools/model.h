#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/field/field.h"
#include "lascaux/skeleton/creature.h"
#include "lascaux/skeleton/skeleton.h"
#include "lascaux/sketch/bitmap.h"
#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"
#include "lascaux/sketch/planar_map.h"
#include "lascaux/sketch/sketch.h"
#include "lascaux/sketch/trace_picture.h"
#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/drawing_colors.h"
#include "lascaux/volume/fidelity.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/mesh_details.h"
#include "lascaux/volume/picture.h"
#include "print_facts.h"
#include "print_record.h"

namespace lascaux {

/// How long each stage took, in milliseconds, in the order of the stages.
struct Timings {
  std::vector<std::pair<std::string, double>> stages;  ///< milliseconds; some run side by side
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  /// What passed from the first byte read to the last file written, the report left out.
  double total = 0;
};

/// The level set of a run; grid.h has it.
struct Grid;

/// What the report says of the level set.
struct GridFacts {
  double voxel_size = 0;  ///< mm
  std::int64_t active_voxels = 0;
  std::int64_t bytes = 0;  ///< in memory
};

/// Everything that a run made, from the drawing to the measured mesh. What an error prevented is
/// empty.
struct Model {
  std::string file;  ///< the sketch as named on the command line
  std::optional<Sketch> sketch;
  std::optional<TraceFacts> trace;  ///< of a picture
  std::optional<Bitmap> picture;    ///< kept when its colours are asked for
  std::optional<PlanarMap> map;
  std::optional<Parts> parts;
  std::optional<DepthGraph> graph;
  std::optional<std::vector<Skeleton>> skeletons;
  std::optional<Creature> creature;
  std::optional<ModelFrame> frame;
  double lift = 0;  ///< mm by which the mesh and the grid lie above the field, which is not moved
  std::optional<Field> field;
  std::shared_ptr<Grid> grid;
  std::optional<GridFacts> grid_facts;
  std::optional<Mesh> mesh;
  std::optional<MeshFacts> facts;
  std::optional<MeshDetails> details;   ///< made when an output holds them
  std::optional<DrawingColors> colors;  ///< the drawing's, if it has any and they are asked for
  std::optional<PrintFacts> print;      ///< measured for outputs that are printed and for reports
  std::optional<PrintRecord> print_record;  ///< when it was asked to be changed for printing
  std::optional<Fidelity> fidelity;
  std::optional<Picture> preview;
  Diagnostics diagnostics;
  Timings timings;
};

}  // namespace lascaux

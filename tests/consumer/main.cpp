#include <cstdio>

#include "lascaux/field/field.h"
#include "lascaux/io/read_file.h"
#include "lascaux/skeleton/creature.h"
#include "lascaux/skeleton/skeleton.h"
#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"
#include "lascaux/sketch/planar_map.h"
#include "lascaux/sketch/read_svg.h"
#include "lascaux/volume/extract_mesh.h"
#include "lascaux/volume/level_set.h"

/// Builds the drawing named on the command line; succeeds when a mesh comes out.
int main(int argc, char** argv) {
  using namespace lascaux;
  if (argc != 2) return 2;
  Diagnostics log;
  const auto bytes = ReadBytes(argv[1]).MoveInto(log);
  if (!bytes) return 3;
  const auto sketch = ReadSvg(*bytes).MoveInto(log);
  if (!sketch) return 3;
  const auto map = BuildPlanarMap(*sketch).MoveInto(log);
  if (!map) return 4;
  const auto parts = FindParts(*map).MoveInto(log);
  if (!parts) return 4;
  const auto graph = OrderByDepth(*map, *parts).MoveInto(log);
  if (!graph) return 4;
  const auto skeletons = ExtractSkeletons(*parts, *graph).MoveInto(log);
  if (!skeletons) return 4;
  const auto creature =
      PlaceInDepth(*parts, *graph, AssembleCreature(*graph, *skeletons)).MoveInto(log);
  if (!creature) return 4;
  const Field field = MakeField(*creature, FrameOf(*parts, *graph, 100));
  const auto grid = Rasterise(field, {.voxel_size = 1}).MoveInto(log);
  if (!grid) return 5;
  const auto mesh = ExtractMesh(**grid).MoveInto(log);
  if (!mesh) return 6;
  std::printf("%zu triangles\n", mesh->triangles.size());
  return mesh->triangles.empty() ? 6 : 0;
}

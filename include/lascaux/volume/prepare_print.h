#pragma once

#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/mesh.h"
#include "lascaux/volume/narrow_band.h"
#include "lascaux/volume/print_options.h"

namespace lascaux {

/// A level set that was changed for printing.
struct PreparedPrint {
  NarrowBand band;
  std::vector<VoxelMask> unchanged;  ///< cells of it that are as they were, for ExtractMesh
  PrintChanges changes;
};

/// Changes a level set so that it prints well, in this order:
///
/// - min_wall: balls of that diameter in the middle of every place where two sides are nearer
///   (FindThinWalls, from each triangle), so that each side moves by half of what is missing, and
///   by less and less towards where nothing is. Measured and done again, with balls up to half a
///   voxel wider, where a wall lacks more than 0.02 voxel, at most 8 times;
/// - base: when the centre of mass is less than 5 % of its height within the feet, a plate under
///   the feet and the point below it. 2.5 % of the longest side thick, of which the feet are in the
///   upper two fifths; it reaches at least 4 % of the longest side, and 15 % of that height,
///   beyond;
/// - hollow: the largest cavity that leaves walls of that thickness, open through a straight drain
///   of 4 mm (at least 4 voxels) downwards from the lowest place of the cavity that holds a ball of
///   that width and does not show in the view from the side, or from the lowest of all if each
///   shows. No cavity where no drain comes out freely.
///
/// `mesh` is the band's surface. Distances of less than a voxel stay as they are, bit by bit, where
/// no change is as near as that.
/// The same bits for any number of threads. Errors: "print-too-coarse" (walls of less than two
/// voxels are asked for), "cancelled".
Outcome<PreparedPrint> PreparePrint(const NarrowBand& band, const Mesh& mesh,
                                    const PrintOptions& options, const Execution& execution = {});

}  // namespace lascaux

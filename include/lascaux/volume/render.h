#pragma once

#include <openvdb/openvdb.h>

#include <cstdint>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/image.h"

/// @file
/// Pictures of a level set, ray-marched on the processor.

namespace lascaux {

/// The drawn side, the face, between the two, from above.
enum class View : std::uint8_t { kSide, kFront, kThreeQuarter, kTop };

/// Where the model's head is along x: kFront and kThreeQuarter show it. kHigher is a guess for when
/// nothing is known: at the end that reaches higher, which is wrong for whales.
enum class Head : std::uint8_t { kHigher, kRight, kLeft };

struct RenderOptions {
  int width = 512, height = 512;  ///< pixels, at least 1
  View view = View::kThreeQuarter;
  Head head = Head::kHigher;

  bool operator==(const RenderOptions&) const = default;
};

/// The model in clay on a pale floor: a large key light from the upper left, light from the sky and
/// the floor with occlusion, a rim light, a soft shadow that fades into the backdrop. Centred,
/// filling 80 % of the frame, seen through a long lens from slightly above; outlines have 8 samples
/// a pixel. Opaque.
///
/// `grid` is a level set by OpenVDB's rules, negative inside, y up, in any unit, with a uniform
/// scale; the floor is at its lowest point. The same bytes for any number of threads. Errors:
/// "empty-grid", "out-of-memory", "cancelled".
///
/// Cost: 512 x 512 pixels of a 256-voxel model take about 0.1 s of one processor, nearly
/// independent of the voxels.
Outcome<Image> Render(const openvdb::FloatGrid& grid, const RenderOptions& options = {},
                      const Execution& execution = {});

}  // namespace lascaux

#pragma once

#include <openvdb/openvdb.h>

#include <cstdint>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/volume/image.h"

/// @file
/// Pictures of a level set, ray-marched on the processor.

namespace lascaux {

enum class View : std::uint8_t { kSide, kFront, kThreeQuarter, kTop };

struct RenderOptions {
  int width = 512, height = 512;
  View view = View::kThreeQuarter;

  bool operator==(const RenderOptions&) const = default;
};

/// A clay-like rendering: soft key light, sky, ambient occlusion, contact shadow on the ground,
/// anti-aliased. Deterministic.
Outcome<Image> Render(const openvdb::FloatGrid& grid, const RenderOptions& options = {},
                      const Execution& execution = {});

}  // namespace lascaux

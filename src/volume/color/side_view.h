#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "lascaux/volume/drawing_colors.h"

namespace lascaux {

inline constexpr std::uint16_t kNoLayer = 0xffff;

/// Which layer of a model is seen from its drawn side in each pixel of a page.
struct SideView {
  std::vector<std::uint16_t> layers;       ///< kNoLayer where nothing is seen
  std::vector<Eigen::AlignedBox2i> boxes;  ///< of each layer: pixels of it, seen or not
};

SideView SeenFromTheSide(const PageColors& page, const ColoredView& view);

}  // namespace lascaux

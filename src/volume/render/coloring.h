#pragma once

#include <Eigen/Core>

#include "volume/render/light.h"

namespace lascaux {

/// Linear albedo of fired clay.
inline Color Clay() { return {0.545F, 0.290F, 0.180F}; }

/// What the surface is made of, place by place. Places are in the surface's index space.
class Coloring {
 public:
  virtual ~Coloring() = default;
  virtual Color AlbedoAt(const Eigen::Vector3f& place) const noexcept = 0;
  /// The part that is there; -1 where none is known.
  virtual float PartAt(const Eigen::Vector3f& place) const noexcept = 0;
};

/// Clay all over.
class ClayColoring final : public Coloring {
 public:
  Color AlbedoAt(const Eigen::Vector3f&) const noexcept override { return Clay(); }
  float PartAt(const Eigen::Vector3f&) const noexcept override { return -1; }
};

}  // namespace lascaux

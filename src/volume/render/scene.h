#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lascaux/volume/render_options.h"
#include "volume/render/camera.h"
#include "volume/render/coarse_field.h"
#include "volume/render/coloring.h"
#include "volume/render/ground_shadow.h"
#include "volume/render/light.h"
#include "volume/render/surface.h"

namespace lascaux {

/// A place in the picture, in pixels.
struct Place {
  float x, y;
  float free;  ///< the part of its ray before this is known to be free
};

/// All that is the same for every pixel: the model, the camera, the lights.
class Scene {
 public:
  /// What the table's leaves belong to and the coloring must outlive it.
  Scene(const LeafTable& surface, const Coloring& coloring, const RenderOptions& options);

  /// How far the rays around (x, y) are free, up to `reach` pixels away in x and in y, given that
  /// they are up to `from`; infinite if none of them meets the model.
  float FreeLength(float x, float y, float reach, float from) const noexcept;

  /// What is seen at each place.
  std::vector<std::optional<Sample>> Trace(std::span<const Place> places) const;

  std::vector<Lighting> Gather(std::span<const Sample> samples) const {
    return studio_.Gather(samples);
  }

  /// Light of the picture where the model is seen, and where it is not.
  Light ModelLight(const Sample& sample, const Lighting& lighting, float x, float y) const;
  Light BackdropLight(float x, float y) const;

  /// Distance from the camera along its axis, in the grid's world units.
  float Depth(const Sample& sample) const noexcept;

  /// The part that is seen; -1 where none is known.
  float Part(const Sample& sample) const noexcept { return coloring_->PartAt(sample.place); }

 private:
  CoarseField coarse_;
  Surface surface_;
  const Coloring* coloring_;
  Camera camera_;
  Studio studio_;
  GroundShadow shadow_;
  Eigen::Vector2f middle_;  ///< of the picture
  Backdrop backdrop_;
  Color backdrop_color_;
  float voxel_size_;
};

}  // namespace lascaux

#include "volume/render/scene.h"

#include <cmath>

#include "volume/render/tone.h"

namespace lascaux {
namespace {

constexpr int kCoarseNodes = 96;  // along the model's longest side

}  // namespace

Scene::Scene(const LeafTable& surface, const Coloring& coloring, const RenderOptions& options)
    : coarse_(surface, kCoarseNodes),
      surface_(surface, coarse_),
      coloring_(&coloring),
      camera_(options, coarse_.SolidNodes()),
      studio_(coarse_, camera_),
      shadow_(studio_, coarse_),
      middle_(0.5F * static_cast<float>(options.width), 0.5F * static_cast<float>(options.height)),
      backdrop_(options.backdrop),
      backdrop_color_(options.backdrop_color[0], options.backdrop_color[1],
                      options.backdrop_color[2]),
      voxel_size_(surface.voxel_size) {}

float Scene::FreeLength(float x, float y, float reach, float from) const noexcept {
  // The diagonal, and a little for rays that are not of length 1 before they are normalised.
  const float spread = 1.5F * reach * camera_.pixel();
  return surface_.FreeLength(camera_.Through(x, y), spread, from);
}

std::vector<std::optional<Sample>> Scene::Trace(std::span<const Place> places) const {
  Rays rays;
  for (const Place& place : places) rays.Add(camera_.Through(place.x, place.y), place.free);
  const std::vector<float> hits = surface_.Hit(rays);
  std::vector<std::optional<Sample>> samples(places.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (std::isinf(hits[i])) continue;
    const Eigen::Vector3f place = rays.At(i, hits[i]);
    samples[i] = Sample{place, surface_.Normal(place)};
  }
  return samples;
}

Light Scene::ModelLight(const Sample& sample, const Lighting& lighting, float x, float y) const {
  const Facet facet{sample.normal, -camera_.Through(x, y).direction,
                    coloring_->AlbedoAt(sample.place)};
  const Color light = studio_.Shade(lighting, facet);
  return Opaque(ToneMapped(light));
}

Light Scene::BackdropLight(float x, float y) const {
  const float shadow = shadow_.At(camera_.Through(x, y));
  switch (backdrop_) {
    case Backdrop::kTransparent:
      return ShadowAlone(shadow);
    case Backdrop::kColor:
      return Opaque(Shadowed(backdrop_color_, shadow));
    case Backdrop::kStudio:
      break;
  }
  const Eigen::Vector2f p = (Eigen::Vector2f(x, y) - middle_) / middle_.maxCoeff();
  return Opaque(Shadowed(Paper(p.x(), p.y()), shadow));
}

float Scene::Depth(const Sample& sample) const noexcept {
  return voxel_size_ * camera_.Depth(sample.place);
}

}  // namespace lascaux

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lascaux/volume/picture.h"
#include "volume/render/scene.h"

namespace lascaux {

/// Paints a picture in two rounds: one ray through the middle of each pixel, then eight where
/// neighbours differ.
///
/// Rows of blocks are independent within a round, so the picture does not depend on the number of
/// threads.
class Painter {
 public:
  /// The scene must outlive it.
  Painter(const Scene& scene, const RenderOptions& options);

  void PaintMiddles();
  void PaintEdges();  ///< after PaintMiddles()
  Picture TakePicture();

 private:
  /// A rectangle of pixels; `right` and `bottom` are past its end.
  struct Block {
    int left, top, right, bottom;
  };
  static constexpr int kBlock = 8;  ///< pixels that share the way through empty space
  /// Of each pixel of a strip, which is a row of blocks.
  using StripLighting = std::vector<Lighting>;

  template <typename PerStrip>
  void ForStrips(const PerStrip& per_strip);
  /// Cuts a block in squares of `size` pixels.
  template <typename PerPart>
  static void ForParts(const Block& block, int size, const PerPart& per_part);

  void TraceStrip(const Block& strip);
  StripLighting GatherStrip(const Block& strip) const;
  void GatherAt(const std::vector<Block>& pixels, StripLighting& lighting) const;
  std::optional<Lighting> BlendedLighting(int x, int y, const Block& cell,
                                          const StripLighting& lighting) const;
  bool IsEdge(int x, int y) const;
  void PaintEdgesOf(const Block& strip);
  std::vector<Light> LightOf(std::span<const Place> places,
                             std::span<const std::optional<Sample>> samples) const;
  void Put(int x, int y, const Light& light);
  void PutLayers(int x, int y);

  std::size_t InStrip(int x, int y) const noexcept;
  std::size_t Index(int x, int y) const noexcept;
  std::size_t QuadIndex(int x, int y) const noexcept;

  const Scene& scene_;
  int width_, height_;
  Layers layers_;
  std::vector<float> free_;  ///< how far the rays of each quad of pixels are free
  std::vector<std::optional<Sample>> samples_;
  Picture picture_;
};

}  // namespace lascaux

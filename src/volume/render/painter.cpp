#include "volume/render/painter.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace lascaux {
namespace {

constexpr int kQuad = 2;  // pixels that share the rest of the way through empty space
constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Places inside a pixel that has an edge in it: a rotated grid, so that edges near either axis get
/// all shades.
constexpr std::array<std::array<float, 2>, 8> kEdgePlaces = {{{0.0625F, 0.4375F},
                                                              {0.1875F, 0.9375F},
                                                              {0.3125F, 0.1875F},
                                                              {0.4375F, 0.6875F},
                                                              {0.5625F, 0.0625F},
                                                              {0.6875F, 0.5625F},
                                                              {0.8125F, 0.8125F},
                                                              {0.9375F, 0.3125F}}};

/// Two places belong to one sheet if one lies within this many voxels of the other's tangent plane
/// and their normals are this close; between neighbours that do not, there is an edge.
constexpr float kSheetVoxels = 2.5F;
constexpr float kSheetCosine = 0.7F;
/// Light is gathered at every kLattice-th pixel of a block and at its last, and taken over where
/// normals are this close; a pixel whose corners have less than this share in it gathers its own.
constexpr int kLattice = 4;
constexpr float kSmoothCosine = 0.9F;
constexpr float kLeastShare = 0.3F;

bool OnOneSheet(const std::optional<Sample>& a, const std::optional<Sample>& b,
                float cosine = kSheetCosine) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->normal.dot(b->normal) > cosine &&
         std::abs(a->normal.dot(b->place - a->place)) < kSheetVoxels;
}

float Middle(int pixel) { return static_cast<float>(pixel) + 0.5F; }

}  // namespace

Painter::Painter(const Scene& scene, const RenderOptions& options)
    : scene_(scene), width_(options.width), height_(options.height), layers_(options.layers) {
  free_.resize(QuadIndex(width_ - 1, height_ - 1) + 1);
  const std::size_t count = Index(width_ - 1, height_ - 1) + 1;
  samples_.resize(count);
  picture_ = {width_, height_, std::vector<float>(4 * count), {}, {}, {}};
  if (layers_ != Layers::kAll) return;
  picture_.depth.assign(count, kNoDepth);
  picture_.normal.resize(3 * count);
  picture_.part.assign(count, -1);
}

Picture Painter::TakePicture() { return std::move(picture_); }

std::size_t Painter::Index(int x, int y) const noexcept {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(x);
}

std::size_t Painter::QuadIndex(int x, int y) const noexcept {
  const int across = (width_ + kQuad - 1) / kQuad;
  return static_cast<std::size_t>(y / kQuad) * static_cast<std::size_t>(across) +
         static_cast<std::size_t>(x / kQuad);
}

/// Blocks begin at multiples of their size.
std::size_t Painter::InBlock(int x, int y) noexcept {
  return static_cast<std::size_t>(y % kBlock * kBlock + x % kBlock);
}

template <typename PerPart>
void Painter::ForParts(const Block& block, int size, const PerPart& per_part) {
  for (int y = block.top; y < block.bottom; y += size) {
    for (int x = block.left; x < block.right; x += size) {
      per_part(Block{x, y, std::min(x + size, block.right), std::min(y + size, block.bottom)});
    }
  }
}

template <typename PerBlock>
void Painter::ForBlocks(const PerBlock& per_block) {
  const int rows = (height_ + kBlock - 1) / kBlock;
  tbb::parallel_for(tbb::blocked_range<int>(0, rows), [&](const auto& range) {
    const Block band{0, range.begin() * kBlock, width_, std::min(range.end() * kBlock, height_)};
    ForParts(band, kBlock, per_block);
  });
}

void Painter::PaintMiddles() {
  ForBlocks([this](const Block& block) {
    TraceBlock(block);
    const BlockLighting lighting = GatherBlock(block);
    ForParts(block, 1, [&](const Block& pixel) {
      const int x = pixel.left, y = pixel.top;
      const std::size_t i = Index(x, y);
      Put(x, y,
          samples_[i]
              ? scene_.ModelLight(*samples_[i], lighting[InBlock(x, y)], Middle(x), Middle(y))
              : scene_.BackdropLight(Middle(x), Middle(y)));
      PutLayers(x, y);
    });
  });
}

void Painter::PaintEdges() {
  ForBlocks([this](const Block& block) {
    std::vector<Block> edges;
    std::vector<Place> places;
    ForParts(block, kQuad, [&](const Block& quad) {
      const float free = free_[QuadIndex(quad.left, quad.top)];
      if (!(free < kNothing)) return;  // no ray in it meets anything
      ForParts(quad, 1, [&](const Block& pixel) {
        if (!IsEdge(pixel.left, pixel.top)) return;
        edges.push_back(pixel);
        for (const auto& [dx, dy] : kEdgePlaces) {
          places.push_back(
              {static_cast<float>(pixel.left) + dx, static_cast<float>(pixel.top) + dy, free});
        }
      });
    });
    const std::vector<std::optional<Sample>> samples = scene_.Trace(places);
    constexpr std::size_t kCount = kEdgePlaces.size();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      Put(edges[i].left, edges[i].top,
          EdgeLight(std::span(places).subspan(kCount * i, kCount),
                    std::span(samples).subspan(kCount * i, kCount)));
    }
  });
}

void Painter::TraceBlock(const Block& block) {
  const auto free_length = [this](const Block& part, int size, float from) {
    const float half = 0.5F * static_cast<float>(size);
    return scene_.FreeLength(static_cast<float>(part.left) + half,
                             static_cast<float>(part.top) + half, half, from);
  };
  const float free = free_length(block, kBlock, 0);
  std::vector<Place> places;
  std::vector<std::size_t> pixels;
  ForParts(block, kQuad, [&](const Block& quad) {
    const float quad_free = free < kNothing ? free_length(quad, kQuad, free) : kNothing;
    free_[QuadIndex(quad.left, quad.top)] = quad_free;
    if (!(quad_free < kNothing)) return;
    ForParts(quad, 1, [&](const Block& pixel) {
      places.push_back({Middle(pixel.left), Middle(pixel.top), quad_free});
      pixels.push_back(Index(pixel.left, pixel.top));
    });
  });
  const std::vector<std::optional<Sample>> found = scene_.Trace(places);
  for (std::size_t i = 0; i < found.size(); ++i) samples_[pixels[i]] = found[i];
}

/// Gathers light at a lattice of pixels, and between them blends those on the same sheet: light
/// that comes from large areas varies slowly.
Painter::BlockLighting Painter::GatherBlock(const Block& block) const {
  BlockLighting lighting;
  const auto is_node = [](int i, int begin, int end) {
    return (i - begin) % kLattice == 0 || i == end - 1;
  };
  ForParts(block, 1, [&](const Block& pixel) {
    if (is_node(pixel.left, block.left, block.right) &&
        is_node(pixel.top, block.top, block.bottom)) {
      const auto& sample = samples_[Index(pixel.left, pixel.top)];
      if (sample) lighting[InBlock(pixel.left, pixel.top)] = scene_.Gather(*sample);
    }
  });
  ForParts(block, 1, [&](const Block& pixel) {
    const int x = pixel.left, y = pixel.top;
    const bool node = is_node(x, block.left, block.right) && is_node(y, block.top, block.bottom);
    if (node || !samples_[Index(x, y)]) return;
    const int left = x - (x - block.left) % kLattice, top = y - (y - block.top) % kLattice;
    const Block cell{left, top, std::min(left + kLattice, block.right - 1),
                     std::min(top + kLattice, block.bottom - 1)};
    lighting[InBlock(x, y)] = BlendedLighting(x, y, cell, lighting);
  });
  return lighting;
}

/// Bilinear between the cell's corners, those on other sheets left out.
Lighting Painter::BlendedLighting(int x, int y, const Block& cell,
                                  const BlockLighting& lighting) const {
  const auto& here = samples_[Index(x, y)];
  const auto share = [](int i, int low, int high) {
    return high > low ? static_cast<float>(i - low) / static_cast<float>(high - low) : 0.F;
  };
  const float u = share(x, cell.left, cell.right), v = share(y, cell.top, cell.bottom);
  Lighting sum;
  float total = 0;
  for (const auto& [nx, ny, weight] : {std::tuple{cell.left, cell.top, (1 - u) * (1 - v)},
                                       {cell.right, cell.top, u * (1 - v)},
                                       {cell.left, cell.bottom, (1 - u) * v},
                                       {cell.right, cell.bottom, u * v}}) {
    const std::size_t there = Index(nx, ny);
    if (weight == 0 || !OnOneSheet(here, samples_[there], kSmoothCosine)) continue;
    sum += lighting[InBlock(nx, ny)] * weight;
    total += weight;
  }
  if (total < kLeastShare) return scene_.Gather(*here);
  return sum * (1 / total);
}

bool Painter::IsEdge(int x, int y) const {
  const auto& here = samples_[Index(x, y)];
  return (x > 0 && !OnOneSheet(here, samples_[Index(x - 1, y)])) ||
         (x + 1 < width_ && !OnOneSheet(here, samples_[Index(x + 1, y)])) ||
         (y > 0 && !OnOneSheet(here, samples_[Index(x, y - 1)])) ||
         (y + 1 < height_ && !OnOneSheet(here, samples_[Index(x, y + 1)]));
}

/// Mean over a pixel's places; each sheet in it is lit once, since light varies little within a
/// pixel.
Light Painter::EdgeLight(std::span<const Place> places,
                         std::span<const std::optional<Sample>> samples) const {
  std::array<std::size_t, kEdgePlaces.size()> first;  // sample of each sheet
  std::array<Light, kEdgePlaces.size()> light;
  std::size_t count = 0;
  Light sum = Light::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto end = first.begin() + static_cast<std::ptrdiff_t>(count);
    const auto known = std::find_if(first.begin(), end, [&](std::size_t other) {
      return OnOneSheet(samples[other], samples[i]);
    });
    const auto sheet = static_cast<std::size_t>(known - first.begin());
    if (known == end) {
      ++count;
      first[sheet] = i;
      const auto& [x, y, free] = places[i];
      light[sheet] = samples[i] ? scene_.ModelLight(*samples[i], scene_.Gather(*samples[i]), x, y)
                                : scene_.BackdropLight(x, y);
    }
    sum += light[sheet];
  }
  return sum / static_cast<float>(samples.size());
}

void Painter::Put(int x, int y, const Light& light) {
  std::copy(light.begin(), light.end(),
            picture_.rgba.begin() + static_cast<std::ptrdiff_t>(4 * Index(x, y)));
}

/// What is seen in the pixel's middle: a mean of depths would be a place where nothing is.
void Painter::PutLayers(int x, int y) {
  const std::size_t i = Index(x, y);
  if (layers_ != Layers::kAll || !samples_[i]) return;
  picture_.depth[i] = scene_.Depth(*samples_[i]);
  picture_.part[i] = scene_.Part(*samples_[i]);
  const Eigen::Vector3f& normal = samples_[i]->normal;
  std::copy(normal.begin(), normal.end(),
            picture_.normal.begin() + static_cast<std::ptrdiff_t>(3 * i));
}

}  // namespace lascaux

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

/// Strips begin at multiples of a block's size.
std::size_t Painter::InStrip(int x, int y) const noexcept { return Index(x, y % kBlock); }

template <typename PerPart>
void Painter::ForParts(const Block& block, int size, const PerPart& per_part) {
  for (int y = block.top; y < block.bottom; y += size) {
    for (int x = block.left; x < block.right; x += size) {
      per_part(Block{x, y, std::min(x + size, block.right), std::min(y + size, block.bottom)});
    }
  }
}

template <typename PerStrip>
void Painter::ForStrips(const PerStrip& per_strip) {
  const int strips = (height_ + kBlock - 1) / kBlock;
  tbb::parallel_for(0, strips, [&](int i) {
    per_strip(Block{0, i * kBlock, width_, std::min((i + 1) * kBlock, height_)});
  });
}

void Painter::PaintMiddles() {
  ForStrips([this](const Block& strip) {
    TraceStrip(strip);
    const StripLighting lighting = GatherStrip(strip);
    ForParts(strip, 1, [&](const Block& pixel) {
      const int x = pixel.left, y = pixel.top;
      const std::size_t i = Index(x, y);
      Put(x, y,
          samples_[i]
              ? scene_.ModelLight(*samples_[i], lighting[InStrip(x, y)], Middle(x), Middle(y))
              : scene_.BackdropLight(Middle(x), Middle(y)));
      PutLayers(x, y);
    });
  });
}

void Painter::PaintEdges() {
  ForStrips([this](const Block& strip) { PaintEdgesOf(strip); });
}

void Painter::PaintEdgesOf(const Block& strip) {
  std::vector<Block> edges;
  std::vector<Place> places;
  ForParts(strip, kQuad, [&](const Block& quad) {
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
  const std::vector<Light> light = LightOf(places, scene_.Trace(places));
  for (std::size_t i = 0; i < edges.size(); ++i) Put(edges[i].left, edges[i].top, light[i]);
}

/// Mean over the places of each pixel; each sheet in it is lit once, since light varies little
/// within a pixel.
std::vector<Light> Painter::LightOf(std::span<const Place> places,
                                    std::span<const std::optional<Sample>> samples) const {
  constexpr std::size_t kCount = kEdgePlaces.size();
  std::vector<std::size_t> first(samples.size());  // place on the same sheet
  std::vector<Sample> sheets;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    first[i] = i / kCount * kCount;
    while (first[i] < i &&
           !(first[first[i]] == first[i] && OnOneSheet(samples[first[i]], samples[i])))
      ++first[i];
    if (first[i] == i && samples[i]) sheets.push_back(*samples[i]);
  }
  const std::vector<Lighting> lighting = scene_.Gather(sheets);
  std::vector<Light> light(samples.size()), mean(samples.size() / kCount, Light::Zero());
  for (std::size_t i = 0, sheet = 0; i < samples.size(); ++i) {
    const auto& [x, y, free] = places[i];
    if (first[i] == i) {
      light[i] = samples[i] ? scene_.ModelLight(*samples[i], lighting[sheet++], x, y)
                            : scene_.BackdropLight(x, y);
    }
    mean[i / kCount] += light[first[i]];
  }
  for (Light& l : mean) l /= static_cast<float>(kCount);
  return mean;
}

void Painter::TraceStrip(const Block& strip) {
  const auto free_length = [this](const Block& part, int size, float from) {
    const float half = 0.5F * static_cast<float>(size);
    return scene_.FreeLength(static_cast<float>(part.left) + half,
                             static_cast<float>(part.top) + half, half, from);
  };
  std::vector<Place> places;
  std::vector<std::size_t> pixels;
  ForParts(strip, kBlock, [&](const Block& block) {
    const float free = free_length(block, kBlock, 0);
    ForParts(block, kQuad, [&](const Block& quad) {
      const float quad_free = free < kNothing ? free_length(quad, kQuad, free) : kNothing;
      free_[QuadIndex(quad.left, quad.top)] = quad_free;
      if (!(quad_free < kNothing)) return;
      ForParts(quad, 1, [&](const Block& pixel) {
        places.push_back({Middle(pixel.left), Middle(pixel.top), quad_free});
        pixels.push_back(Index(pixel.left, pixel.top));
      });
    });
  });
  const std::vector<std::optional<Sample>> found = scene_.Trace(places);
  for (std::size_t i = 0; i < found.size(); ++i) samples_[pixels[i]] = found[i];
}

/// Gathers light at a lattice of each block's pixels, and between them blends those on the same
/// sheet: light that comes from large areas varies slowly.
Painter::StripLighting Painter::GatherStrip(const Block& strip) const {
  const auto is_node = [](int i, int begin, int end) {
    return (i - begin) % kLattice == 0 || i == end - 1;
  };
  std::vector<Block> nodes, others;
  const auto for_seen = [&](const auto& use) {
    ForParts(strip, kBlock, [&](const Block& block) {
      ForParts(block, 1, [&](const Block& pixel) {
        if (!samples_[Index(pixel.left, pixel.top)]) return;
        use(block, pixel,
            is_node(pixel.left, block.left, block.right) &&
                is_node(pixel.top, block.top, block.bottom));
      });
    });
  };
  for_seen([&](const Block&, const Block& pixel, bool node) {
    if (node) nodes.push_back(pixel);
  });
  StripLighting lighting(static_cast<std::size_t>(width_) * kBlock);
  GatherAt(nodes, lighting);
  for_seen([&](const Block& block, const Block& pixel, bool node) {
    if (node) return;
    const int x = pixel.left, y = pixel.top;
    const int left = x - (x - block.left) % kLattice, top = y - (y - block.top) % kLattice;
    const Block cell{left, top, std::min(left + kLattice, block.right - 1),
                     std::min(top + kLattice, block.bottom - 1)};
    if (const auto blended = BlendedLighting(x, y, cell, lighting))
      lighting[InStrip(x, y)] = *blended;
    else
      others.push_back(pixel);
  });
  GatherAt(others, lighting);
  return lighting;
}

void Painter::GatherAt(const std::vector<Block>& pixels, StripLighting& lighting) const {
  std::vector<Sample> samples;
  for (const Block& pixel : pixels) samples.push_back(*samples_[Index(pixel.left, pixel.top)]);
  const std::vector<Lighting> found = scene_.Gather(samples);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    lighting[InStrip(pixels[i].left, pixels[i].top)] = found[i];
}

/// Bilinear between the cell's corners, those on other sheets left out; nothing where too little is
/// left.
std::optional<Lighting> Painter::BlendedLighting(int x, int y, const Block& cell,
                                                 const StripLighting& lighting) const {
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
    sum += lighting[InStrip(nx, ny)] * weight;
    total += weight;
  }
  if (total < kLeastShare) return std::nullopt;
  return sum * (1 / total);
}

bool Painter::IsEdge(int x, int y) const {
  const auto& here = samples_[Index(x, y)];
  return (x > 0 && !OnOneSheet(here, samples_[Index(x - 1, y)])) ||
         (x + 1 < width_ && !OnOneSheet(here, samples_[Index(x + 1, y)])) ||
         (y > 0 && !OnOneSheet(here, samples_[Index(x, y - 1)])) ||
         (y + 1 < height_ && !OnOneSheet(here, samples_[Index(x, y + 1)]));
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

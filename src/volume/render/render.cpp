#include "lascaux/volume/render.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "volume/arena.h"
#include "volume/render/camera.h"
#include "volume/render/ground_shadow.h"
#include "volume/render/light.h"
#include "volume/render/surface.h"
#include "volume/render/tone.h"

namespace lascaux {
namespace {

constexpr int kCoarseNodes = 96;  // along the model's longest side
constexpr int kBlock = 8;         // pixels that share the way through empty space
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
/// Light is taken over from neighbours whose normals are this close.
constexpr float kSmoothCosine = 0.94F;

/// Where a ray met the model.
struct Sample {
  Eigen::Vector3f place, normal;
};

bool OnOneSheet(const std::optional<Sample>& a, const std::optional<Sample>& b,
                float cosine = kSheetCosine) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->normal.dot(b->normal) > cosine &&
         std::abs(a->normal.dot(b->place - a->place)) < kSheetVoxels;
}

/// All that is the same for every pixel.
class Scene {
 public:
  Scene(const openvdb::FloatGrid& grid, const RenderOptions& options)
      : coarse(grid, kCoarseNodes),
        surface(grid, coarse),
        camera(options, coarse.SolidNodes()),
        studio(coarse, camera),
        shadow(studio, coarse),
        middle_(0.5F * static_cast<float>(options.width),
                0.5F * static_cast<float>(options.height)) {}

  /// What is seen at a place in pixels; everything before `from` is known to be free.
  std::optional<Sample> Trace(float x, float y, float from) const {
    const Ray ray = camera.Through(x, y);
    const std::optional<float> t = surface.Hit(ray, from);
    if (!t) return std::nullopt;
    return Sample{ray.At(*t), surface.Normal(ray.At(*t))};
  }

  /// Light of the picture at a place in pixels where the model is seen.
  Color ModelLight(const Sample& sample, const Lighting& lighting, float x, float y) const {
    return ToneMapped(studio.Shade(lighting, sample.normal, -camera.Through(x, y).direction));
  }

  /// The same where the backdrop is seen.
  Color BackdropLight(float x, float y) const {
    const Eigen::Vector2f p = (Eigen::Vector2f(x, y) - middle_) / middle_.maxCoeff();
    return Shadowed(Backdrop(p.x(), p.y()), shadow.At(camera.Through(x, y)));
  }

  Color Light(const std::optional<Sample>& sample, float x, float y) const {
    if (!sample) return BackdropLight(x, y);
    return ModelLight(*sample, studio.Gather(sample->place, sample->normal), x, y);
  }

  const CoarseField coarse;
  const Surface surface;
  const Camera camera;
  const Studio studio;
  const GroundShadow shadow;

 private:
  Eigen::Vector2f middle_;
};

/// Paints a picture in two rounds: one ray through the middle of each pixel, then more where
/// neighbours differ.
class Painter {
 public:
  Painter(const Scene& scene, const RenderOptions& options)
      : scene_(scene),
        width_(options.width),
        height_(options.height),
        blocks_across_((width_ + kBlock - 1) / kBlock) {
    const int blocks_down = (height_ + kBlock - 1) / kBlock;
    free_.resize(static_cast<std::size_t>(blocks_across_) * static_cast<std::size_t>(blocks_down));
    const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    samples_.resize(count);
    lighting_.resize(count);
    image_ = {width_, height_, std::vector<std::uint8_t>(4 * count, 255)};
  }

  void PaintMiddles() {
    ForBlocks([this](int left, int top) {
      const float half = 0.5F * kBlock;
      // Pixels beside the block's have a say in its edges: the cone is a pixel wider.
      const float spread = scene_.camera.pixel() * (half + 1) * 1.5F;
      const Ray middle =
          scene_.camera.Through(static_cast<float>(left) + half, static_cast<float>(top) + half);
      const float free = scene_.surface.FreeLength(middle, spread);
      Free(left, top) = free;
      ForPixels(left, top, [&](int x, int y) {
        if (free < kNothing) samples_[Index(x, y)] = scene_.Trace(Middle(x), Middle(y), free);
      });
      if (free < kNothing) Gather(left, top);
      ForPixels(left, top, [&](int x, int y) {
        const auto& sample = samples_[Index(x, y)];
        Put(x, y,
            sample ? scene_.ModelLight(*sample, lighting_[Index(x, y)], Middle(x), Middle(y))
                   : scene_.BackdropLight(Middle(x), Middle(y)));
      });
    });
  }

  void PaintEdges() {
    ForBlocks([this](int left, int top) {
      if (!(Free(left, top) < kNothing)) return;
      ForPixels(left, top, [this](int x, int y) {
        if (IsEdge(x, y)) Put(x, y, EdgeLight(x, y));
      });
    });
  }

  Image TakeImage() { return std::move(image_); }

 private:
  template <typename PerBlock>
  void ForBlocks(const PerBlock& per_block) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, free_.size(), 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const auto across = static_cast<std::size_t>(blocks_across_);
        per_block(kBlock * static_cast<int>(i % across), kBlock * static_cast<int>(i / across));
      }
    });
  }

  template <typename PerPixel>
  void ForPixels(int left, int top, const PerPixel& per_pixel) {
    const int right = std::min(left + kBlock, width_), bottom = std::min(top + kBlock, height_);
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) per_pixel(x, y);
    }
  }

  static float Middle(int pixel) { return static_cast<float>(pixel) + 0.5F; }

  /// Gathers light at every other pixel of a block, and between them takes the mean of those on the
  /// same sheet.
  void Gather(int left, int top) {
    const auto gathers = [](int i) { return i % 2 == 0 || i == kBlock - 1; };
    const auto gather = [&](int x, int y) {
      const auto& sample = samples_[Index(x, y)];
      if (sample) lighting_[Index(x, y)] = scene_.studio.Gather(sample->place, sample->normal);
    };
    ForPixels(left, top, [&](int x, int y) {
      if (gathers(x - left) && gathers(y - top)) gather(x, y);
    });
    ForPixels(left, top, [&](int x, int y) {
      if (gathers(x - left) && gathers(y - top)) return;
      const int dx = gathers(x - left) ? 0 : 1, dy = gathers(y - top) ? 0 : 1;
      const auto& here = samples_[Index(x, y)];
      if (!here) return;
      Lighting sum;
      int count = 0;
      for (const int ny : {y - dy, y + dy}) {
        for (const int nx : {x - dx, x + dx}) {
          if (nx >= width_ || ny >= height_) continue;
          const auto& there = samples_[Index(nx, ny)];
          if (!there || !OnOneSheet(here, there, kSmoothCosine)) continue;
          sum += lighting_[Index(nx, ny)];
          ++count;
        }
      }
      if (count == 0) return gather(x, y);
      lighting_[Index(x, y)] = sum / static_cast<float>(count);
    });
  }

  /// How far all rays of a pixel's block are free.
  float& Free(int x, int y) {
    return free_[static_cast<std::size_t>((y / kBlock) * blocks_across_ + x / kBlock)];
  }

  bool IsEdge(int x, int y) const {
    const auto& here = samples_[Index(x, y)];
    return (x > 0 && !OnOneSheet(here, samples_[Index(x - 1, y)])) ||
           (x + 1 < width_ && !OnOneSheet(here, samples_[Index(x + 1, y)])) ||
           (y > 0 && !OnOneSheet(here, samples_[Index(x, y - 1)])) ||
           (y + 1 < height_ && !OnOneSheet(here, samples_[Index(x, y + 1)]));
  }

  /// Mean over the pixel; each sheet in it is lit once, since light varies little within a pixel.
  Color EdgeLight(int x, int y) {
    struct Sheet {
      std::optional<Sample> sample;
      Color light;
    };
    std::vector<Sheet> sheets;
    const float free = Free(x, y);
    Color sum(0, 0, 0);
    for (const auto& [dx, dy] : kEdgePlaces) {
      const float px = static_cast<float>(x) + dx, py = static_cast<float>(y) + dy;
      const auto sample = scene_.Trace(px, py, free);
      auto sheet = std::find_if(sheets.begin(), sheets.end(), [&](const Sheet& known) {
        return OnOneSheet(known.sample, sample);
      });
      if (sheet == sheets.end()) {
        sheet = sheets.insert(sheet, {sample, scene_.Light(sample, px, py)});
      }
      sum += sheet->light;
    }
    return sum / static_cast<float>(kEdgePlaces.size());
  }

  void Put(int x, int y, const Color& light) {
    const auto bytes = Encode(light);
    std::copy(bytes.begin(), bytes.end(),
              image_.rgba.begin() + static_cast<std::ptrdiff_t>(4 * Index(x, y)));
  }

  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  const Scene& scene_;
  int width_, height_, blocks_across_;
  std::vector<float> free_;
  std::vector<std::optional<Sample>> samples_;
  std::vector<Lighting> lighting_;
  Image image_;
};

std::optional<Image> Paint(const openvdb::FloatGrid& grid, const RenderOptions& options,
                           const Execution& execution) {
  const Scene scene(grid, options);
  Painter painter(scene, options);
  if (execution.IsCancelled()) return std::nullopt;
  painter.PaintMiddles();
  if (execution.IsCancelled()) return std::nullopt;
  painter.PaintEdges();
  return painter.TakeImage();
}

}  // namespace

Outcome<Image> Render(const openvdb::FloatGrid& grid, const RenderOptions& options,
                      const Execution& execution) {
  assert(options.width > 0 && options.height > 0);
  using Result = Outcome<Image>;
  if (grid.activeVoxelCount() == 0) {
    return Result::Failure(Error(FailureKind::kInput, "empty-grid",
                                 "the level set has no active voxel: there is nothing to show"));
  }
  std::optional<Image> image;
  try {
    RunInArena(execution, [&] { image = Paint(grid, options, execution); });
  } catch (const std::bad_alloc&) {
    return Result::Failure(Error(FailureKind::kUsage, "out-of-memory",
                                 "the picture does not fit into memory; ask for a smaller one"));
  }
  if (!image) {
    return Result::Failure(
        Error(FailureKind::kInterrupted, "cancelled", "interrupted while rendering"));
  }
  return *std::move(image);
}

}  // namespace lascaux

#include "volume/finish_band.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "volume/lanes.h"

namespace lascaux {
namespace {

using Eigen::Vector3i;

/// A block of the result: the swept block at its z and, for one below the plane, whose voxels are
/// one off, the block above that. One of the two may be missing.
struct Source {
  Vector3i origin;
  std::int32_t block, above;
  bool is_lower;
};

std::vector<Source> ListSources(const Band& band) {
  std::vector<Source> list;
  for (std::size_t b = 0; b < band.size(); ++b)
    list.push_back({band.origins[b], static_cast<std::int32_t>(b), kNoBlock, false});
  if (!band.upper_half) return list;
  for (std::size_t b = 0; b < band.size(); ++b) {
    const auto index = static_cast<std::int32_t>(b);
    const Vector3i& at = band.origins[b];
    const Vector3i image(at.x(), at.y(), -kBlockSide - at.z());
    list.push_back({image, index, band.neighbours[b][5], true});
    if (at.z() > 0 && band.neighbours[b][4] == kNoBlock)
      list.push_back({image + Vector3i(0, 0, kBlockSide), kNoBlock, index, true});
  }
  return list;
}

/// Distances of a block's voxels, and which are inside.
struct Content {
  const float* distance;
  VoxelMask inside;
};

/// The bits of a byte in reverse.
std::uint64_t Reversed(std::uint64_t byte) {
  byte = (byte >> 4 & 0x0F) | (byte << 4 & 0xF0);
  byte = (byte >> 2 & 0x33) | (byte << 2 & 0xCC);
  return (byte >> 1 & 0x55) | (byte << 1 & 0xAA);
}

/// Where a block's values go.
struct Target {
  std::span<float> values;
  VoxelMask& active;
};

class Writer {
 public:
  Writer(const Band& band, double voxel_size)
      : band_(band),
        voxel_(static_cast<float>(voxel_size)),
        background_(BandBackground(voxel_size)) {
    if (!IsSupported(Isa::kAvx2)) return;
    has_band_ = HasBandAvx2;
    write_ = WriteAvx2;
  }

  /// Does it hold a voxel of the band?
  bool HasBand(const Source& source) const {
    Memory memory;
    const Content content = ContentOf(source, memory);
    return has_band_(content.distance, *this);
  }

  /// On which side is its first voxel?
  bool IsInside(const Source& source) const {
    Memory memory;
    return (ContentOf(source, memory).inside[0] & 1) != 0;
  }

  void Write(const Source& source, const Target& target) const {
    Memory memory;
    write_(ContentOf(source, memory), *this, target);
  }

  LASCAUX_INLINE bool HasBandIn(const float* distances) const {
    Lanes least = Load(distances);
    for (std::size_t at = kLanes; at < kBlockVoxels; at += kLanes)
      least = Min(least, Load(distances + at));
    return BitsOf(IsBand(least, Scaled(least))) != 0;
  }

  LASCAUX_INLINE void WriteLines(const Content& content, const Target& target) const {
    target.active = {};
    for (std::size_t at = 0; at < kBlockVoxels; at += kLanes) {
      const Lanes distance = Load(content.distance + at), scaled = Scaled(distance);
      const LaneMask is_band = IsBand(distance, scaled);
      const Lanes magnitude = is_band ? scaled : All(background_);
      const LaneMask is_inside = LanesIn(content.inside[at / 64] >> at % 64 & 0xFF);
      Store(is_inside ? -magnitude : magnitude, target.values.data() + at);
      target.active[at / 64] |= BitsOf(is_band) << at % 64;
    }
  }

 private:
  using Memory = std::array<float, kBlockVoxels>;

  LASCAUX_INLINE Lanes Scaled(const Lanes& distance) const {
    return Max(distance, All(kLeastDistance)) * voxel_;
  }

  // Rounding must not take an active value to the background, or it would not be in the band.
  LASCAUX_INLINE LaneMask IsBand(const Lanes& distance, const Lanes& scaled) const {
    return (distance < static_cast<float>(kBandVoxels)) & (scaled < background_);
  }

  /// `memory` is for the image of a block, where it is none of the band's own.
  Content ContentOf(const Source& source, Memory& memory) const {
    const auto block = static_cast<std::size_t>(source.block);
    if (!source.is_lower) return {DistancesOf(block), band_.inside[block]};
    Content content{memory.data(), {}};
    for (std::size_t at = 0; at < kBlockVoxels; at += kLanes) {
      const std::uint64_t inside = MirrorLine(source, at, memory.data() + at);
      content.inside[at / 64] |= inside << at % 64;
    }
    return content;
  }

  /// A line of the image: its voxel k is at -8 - z + k, the image of 8 - k above the block's
  /// lowest. Returns which are inside. Missing ones are far from the surface, so on the same side
  /// as the voxel that touches them.
  std::uint64_t MirrorLine(const Source& source, std::size_t at, float* line) const {
    const bool has_block = source.block != kNoBlock, has_above = source.above != kNoBlock;
    std::uint64_t inside = 0;
    if (has_block) {
      const auto block = static_cast<std::size_t>(source.block);
      const float* const from = DistancesOf(block) + at;
      for (std::size_t k = 1; k < kLanes; ++k) line[k] = from[kLanes - k];
      inside = Reversed(InsideLine(block, at)) << 1 & 0xFE;
      if (!has_above) inside |= InsideLine(block, at) >> 7;
    }
    line[0] = kFar;
    if (has_above) {
      const auto above = static_cast<std::size_t>(source.above);
      line[0] = DistancesOf(above)[at];
      const std::uint64_t first = InsideLine(above, at) & 1;
      inside |= first;
      if (!has_block) {
        std::fill_n(line + 1, kLanes - 1, kFar);
        inside = first * 0xFF;
      }
    }
    return inside;
  }

  const float* DistancesOf(std::size_t block) const {
    return band_.distance.data() + kBlockVoxels * block;
  }
  std::uint64_t InsideLine(std::size_t block, std::size_t at) const {
    return band_.inside[block][at / 64] >> at % 64 & 0xFF;
  }

  // The same code twice, with the same bits: see sweep.cpp.
  static bool HasBandBaseline(const float* distances, const Writer& self) {
    return self.HasBandIn(distances);
  }
  static void WriteBaseline(const Content& content, const Writer& self, const Target& target) {
    self.WriteLines(content, target);
  }
#if defined(__x86_64__)
  [[gnu::target("avx2")]] static bool HasBandAvx2(const float* distances, const Writer& self) {
    return self.HasBandIn(distances);
  }
  [[gnu::target("avx2")]] static void WriteAvx2(const Content& content, const Writer& self,
                                                const Target& target) {
    self.WriteLines(content, target);
  }
#else
  static constexpr auto HasBandAvx2 = HasBandBaseline;
  static constexpr auto WriteAvx2 = WriteBaseline;
#endif

  const Band& band_;
  float voxel_, background_;
  decltype(&HasBandBaseline) has_band_ = HasBandBaseline;
  decltype(&WriteBaseline) write_ = WriteBaseline;
};

}  // namespace

float BandBackground(double voxel_size) {
  const double least = kBandVoxels * voxel_size;
  auto background = static_cast<float>(least);
  while (static_cast<double>(background) < least) {
    background = std::nextafter(background, std::numeric_limits<float>::infinity());
  }
  return background;
}

NarrowBand FinishBand(const Band& band, const std::vector<Cube>& inside, double voxel_size) {
  const Writer writer(band, voxel_size);
  const std::vector<Source> sources = ListSources(band);
  std::vector<std::uint8_t> has_band(sources.size());
  tbb::parallel_for(std::size_t{0}, sources.size(),
                    [&](std::size_t i) { has_band[i] = writer.HasBand(sources[i]) ? 1 : 0; });

  NarrowBand result;
  result.voxel_size = voxel_size;
  result.background = BandBackground(voxel_size);
  for (const Cube& cube : inside) {
    result.inside.push_back(cube);
    if (!band.upper_half) continue;
    const Vector3i& at = cube.origin;
    result.inside.push_back({{at.x(), at.y(), -cube.side - at.z()}, cube.side});
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (has_band[i] != 0) {
      kept.push_back(i);
      result.blocks.push_back(sources[i].origin);
    } else if (writer.IsInside(sources[i])) {
      result.inside.push_back({sources[i].origin, kBlockSide});
    }
  }
  result.values.resize(kBlockVoxels * kept.size());
  result.active.resize(kept.size());
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t k) {
    const std::span values = std::span(result.values).subspan(kBlockVoxels * k, kBlockVoxels);
    writer.Write(sources[kept[k]], {values, result.active[k]});
  });
  return result;
}

}  // namespace lascaux

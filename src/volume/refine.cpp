#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "volume/band.h"
#include "volume/band_view.h"
#include "volume/block_samples.h"
#include "volume/lanes.h"

namespace lascaux {
namespace {

// The scheme errs by up to that much at radii of three voxels. Where the field says more, it speaks
// of another piece of the surface (in a crotch, beside a thin part), and the scheme is believed.
constexpr float kLargestCorrection = 0.35F;

/// A vector in each lane.
struct LaneVectors {
  Lanes x, y, z;
};

LASCAUX_INLINE Lanes Dot(const LaneVectors& a, const LaneVectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Of length 1; a vector of length 0 remains as it is.
LASCAUX_INLINE LaneVectors Normalized(const LaneVectors& a) {
  const Lanes square = Dot(a, a);
  const Lanes scale = 1 / (square > 0 ? Root(square) : All(1));
  return {scale * a.x, scale * a.y, scale * a.z};
}

/// Towards the smaller neighbour along an axis, by how much it is less.
LASCAUX_INLINE Lanes Fall(const Lanes& own, const Lanes& low, const Lanes& high) {
  const Lanes fall = Max(own - Min(low, high), Lanes{});
  return low < high ? -fall : fall;
}

/// Unit vectors towards the surface from a line of voxels, by the differences that the scheme
/// itself took.
LASCAUX_INLINE LaneVectors Descent(const BandView& view, std::size_t at) {
  const Lanes own = Load(view.Line(at));
  const std::array<const float*, 4> beside = view.LinesBeside(at);
  return Normalized({Fall(own, Load(beside[0]), Load(beside[1])),
                     Fall(own, Load(beside[2]), Load(beside[3])),
                     Fall(own, Before(own, view.BeforeLine(at)), After(own, view.AfterLine(at)))});
}

/// Numbers of up to a block's voxels, of which whole lines can be read.
struct alignas(64) Column {
  std::array<float, kBlockVoxels + kLanes> at;
};

/// Voxels of a block that are refined, with the way to the surface.
struct Chosen {
  std::array<std::uint16_t, kBlockVoxels> voxel;
  Column distance, way_x, way_y, way_z;
  Column side;  ///< -1 inside, 1 outside
  std::size_t count = 0;
};

/// All voxels that the sweep reached from elsewhere.
LASCAUX_INLINE void Choose(const BandView& view, const VoxelMask& crossings, Chosen& chosen) {
  for (std::size_t at = 0; at < kBlockVoxels; at += kLanes) {
    const Lanes distance = Load(view.Line(at));
    std::uint64_t bits = BitsOf(distance < kSweepVoxels) & ~(crossings[at / 64] >> at % 64);
    if (bits == 0) continue;
    const LaneVectors way = Descent(view, at);
    std::array<float, kLanes> x, y, z;
    Store(way.x, x.data());
    Store(way.y, y.data());
    Store(way.z, z.data());
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t k = chosen.count++;
      chosen.voxel[k] = static_cast<std::uint16_t>(at + lane);
      chosen.distance.at[k] = view.At(at + lane);
      chosen.way_x.at[k] = x[lane];
      chosen.way_y.at[k] = y[lane];
      chosen.way_z.at[k] = z[lane];
      chosen.side.at[k] = view.IsInside(at + lane) ? -1.0F : 1.0F;
    }
  }
}

/// Replaces the chosen ones' distances in `out`, by the samples at their feet.
LASCAUX_INLINE void Correct(const Chosen& chosen, const Samples& feet, float voxel, float* out) {
  for (std::size_t k = 0; k < chosen.count; k += kLanes) {
    const LaneVectors inward = Normalized(
        {Load(&feet.gradient_x[k]), Load(&feet.gradient_y[k]), Load(&feet.gradient_z[k])});
    // From the voxel to the plane that is tangent below the foot.
    const Lanes distance = Load(&chosen.distance.at[k]);
    const LaneVectors way = {Load(&chosen.way_x.at[k]), Load(&chosen.way_y.at[k]),
                             Load(&chosen.way_z.at[k])};
    const Lanes outside = distance * Dot(way, inward) + Load(&feet.distance[k]) * (1 / voxel);
    const Lanes refined = Load(&chosen.side.at[k]) * outside;
    const Lanes correction = refined - distance;
    const Lanes size = correction < 0 ? -correction : correction;
    std::array<float, kLanes> result;
    Store(size <= kLargestCorrection ? Max(refined, Lanes{}) : distance, result.data());
    const std::size_t count = std::min(kLanes, chosen.count - k);
    for (std::size_t i = 0; i < count; ++i) out[chosen.voxel[k + i]] = result[i];
  }
}

/// The same code twice, with the same bits: see sweep.cpp.
struct LaneCode {
  void (*choose)(const BandView&, const VoxelMask&, Chosen&);
  void (*correct)(const Chosen&, const Samples&, float, float*);
};
void ChooseBaseline(const BandView& view, const VoxelMask& crossings, Chosen& chosen) {
  Choose(view, crossings, chosen);
}
void CorrectBaseline(const Chosen& chosen, const Samples& feet, float voxel, float* out) {
  Correct(chosen, feet, voxel, out);
}
constexpr LaneCode kBaseline = {ChooseBaseline, CorrectBaseline};
#if defined(__x86_64__)
[[gnu::target("avx2")]] void ChooseAvx2(const BandView& view, const VoxelMask& crossings,
                                        Chosen& chosen) {
  Choose(view, crossings, chosen);
}
[[gnu::target("avx2")]] void CorrectAvx2(const Chosen& chosen, const Samples& feet, float voxel,
                                         float* out) {
  Correct(chosen, feet, voxel, out);
}
constexpr LaneCode kAvx2 = {ChooseAvx2, CorrectAvx2};
#else
constexpr LaneCode kAvx2 = kBaseline;
#endif

/// Refines one block at a time; reads the band's distances and leaves them.
class BlockRefiner {
 public:
  BlockRefiner(const BandSource& source, const Band& band)
      : source_(source),
        band_(band),
        offsets_(source.voxel_size),
        code_(source.field.isa() == Isa::kBaseline ? kBaseline : kAvx2) {}

  void Run(std::size_t b, const VoxelMask& crossings, std::span<float> out) const {
    const BandView view(band_, band_.distance, b);
    std::copy_n(view.Line(0), kBlockVoxels, out.data());
    Chosen chosen;
    code_.choose(view, crossings, chosen);
    if (chosen.count == 0) return;
    const auto h = static_cast<float>(source_.voxel_size);
    Samples feet;
    for (std::size_t k = 0; k < chosen.count; ++k) {
      const std::size_t i = chosen.voxel[k];
      const float way = h * chosen.distance.at[k];
      feet.x[k] = offsets_.x[i] + way * chosen.way_x.at[k];
      feet.y[k] = offsets_.y[i] + way * chosen.way_y.at[k];
      feet.z[k] = offsets_.z[i] + way * chosen.way_z.at[k];
    }
    const Block& block = source_.blocks[b];
    feet.Evaluate(source_.field, block, BlockCenter(block, source_.voxel_size), chosen.count,
                  kFar * h);
    code_.correct(chosen, feet, h, out.data());
  }

 private:
  const BandSource& source_;
  const Band& band_;
  BlockOffsets offsets_;
  LaneCode code_;
};

}  // namespace

void RefineDistances(const BandSource& source, const std::vector<VoxelMask>& crossings, Band& band,
                     const Execution& execution) {
  VoxelFloats refined(band.distance.size());
  const BlockRefiner refiner(source, band);
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    if (execution.IsCancelled()) return;
    refiner.Run(b, crossings[b], std::span(refined).subspan(kBlockVoxels * b, kBlockVoxels));
  });
  band.distance = std::move(refined);
}

}  // namespace lascaux

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "volume/band.h"
#include "volume/band_view.h"

namespace lascaux {
namespace {

// Four lanes: what every x86-64 and ARM processor has, in the notation that g++ and clang share.
constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;

inline Lanes All(float value) { return Lanes{} + value; }

inline Lanes Load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline Lanes Min(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes Max(Lanes a, Lanes b) { return a < b ? b : a; }

/// Square root of what is positive, 0 of the rest.
inline Lanes Root(Lanes a) {
  a = Max(a, Lanes{});
  for (std::size_t k = 0; k < kLanes; ++k) a[k] = std::sqrt(a[k]);
  return a;
}

/// The solution of Godunov's scheme from the smaller neighbour along each axis.
inline Lanes Solve(Lanes x, Lanes y, Lanes z) {
  const Lanes low = Min(x, y), high = Max(x, y);
  const Lanes a = Min(low, z);
  // Relative to the smallest, so that no digits are lost in squares.
  const Lanes b = Max(low, Min(high, z)) - a, c = Max(high, z) - a;
  const Lanes two = 0.5F * (b + Root(2.0F - b * b));
  const Lanes sum = b + c;
  const Lanes three = (1.0F / 3.0F) * (sum + Root(sum * sum - 3.0F * (b * b + c * c - 1.0F)));
  const Lanes beyond_b = two > c ? three : two;
  return a + (b < 1.0F ? beyond_b : All(1));
}

/// The new values of a line; `fixed` is below kFar where a value is given. Returns whether a value
/// within the band changed.
inline bool UpdateLine(const BandView& view, std::size_t at, const float* fixed, float* out) {
  const float* const line = view.Line(at);
  const std::array<const float*, 4> beside = view.LinesBeside(at);
  std::array<float, 10> z;
  z[0] = view.BeforeLine(at);
  std::memcpy(&z[1], line, 8 * sizeof(float));
  z[9] = view.AfterLine(at);
  Lanes largest_change{};
  for (std::size_t k = 0; k < 8; k += kLanes) {
    const Lanes own = Load(line + k), given = Load(fixed + at + k);
    const Lanes solved =
        Solve(Min(Load(beside[0] + k), Load(beside[1] + k)),
              Min(Load(beside[2] + k), Load(beside[3] + k)), Min(Load(&z[k]), Load(&z[k + 2])));
    const Lanes next = given < kFar ? given : Min(solved, own);
    const Lanes change = next < kSweepVoxels ? own - next : Lanes{};
    largest_change = Max(largest_change, change);
    std::memcpy(out + at + k, &next, sizeof next);
  }
  float largest = 0;
  for (std::size_t k = 0; k < kLanes; ++k) largest = std::max(largest, largest_change[k]);
  return largest > 0;
}

/// One bit a line of eight along z: bit 8 x + y.
using LineMask = std::uint64_t;

/// Lines that have a line in `changed` beside them, or are in it.
LineMask LinesToUpdate(const Band& band, std::size_t block, const std::vector<LineMask>& changed) {
  constexpr LineMask kFirstY = 0x0101010101010101, kLastY = kFirstY << 7;
  const auto beside = [&](std::size_t side) {
    const std::int32_t n = band.neighbours[block][side];
    return n == kNoBlock ? LineMask{0} : changed[static_cast<std::size_t>(n)];
  };
  const LineMask own = changed[block];
  const LineMask along_x = own << 8 | own >> 8 | beside(0) >> 56 | beside(1) << 56;
  const LineMask along_y = (own << 1 & ~kFirstY) | (own >> 1 & ~kLastY) |
                           (beside(2) >> 7 & kFirstY) | (beside(3) << 7 & kLastY);
  return own | along_x | along_y | beside(4) | beside(5);
}

/// One iteration of the lines in `lines` of one block: to `out`, from the values around it. Returns
/// the lines in which a value within the band changed.
LineMask Iterate(const BandView& view, LineMask lines, const float* fixed, float* out) {
  LineMask changed = 0;
  for (; lines != 0; lines &= lines - 1) {
    const auto bit = static_cast<std::size_t>(std::countr_zero(lines));
    if (UpdateLine(view, 8 * bit, fixed, out)) changed |= LineMask{1} << bit;
  }
  return changed;
}

/// The distance at a crossing. Along an axis, the distances of two voxels on different sides can't
/// add up to more than the voxel between them; where they do, in creases that one of them does not
/// see, they are scaled down.
float DistanceAtCrossing(const BandView& view, std::size_t i) {
  const float own = std::min(view.At(i), 1.0F);
  float most = own;
  for (std::size_t side = 0; side < 6; ++side) {
    if (view.IsInsideBeside(i, side) == view.IsInside(i)) continue;
    const float beyond = std::min(view.Beside(i, side), 1.0F);
    if (own + beyond > 1) most = std::min(most, own / (own + beyond));
  }
  return most;
}

/// Distances at the crossings, kFar elsewhere; sets in `lines` those that have some.
std::vector<float> FixCrossings(const Band& band, const std::vector<VoxelMask>& crossings,
                                std::vector<LineMask>& lines) {
  std::vector<float> fixed(band.distance.size(), kFar);
  lines.assign(band.size(), 0);
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    const BandView view(band, band.distance, b);
    for (std::size_t x = 0; x < 8; ++x) {
      for (std::uint64_t word = crossings[b][x]; word != 0; word &= word - 1) {
        const std::size_t i = 64 * x + static_cast<std::size_t>(std::countr_zero(word));
        fixed[kBlockVoxels * b + i] = DistanceAtCrossing(view, i);
        lines[b] |= LineMask{1} << i / 8;
      }
    }
  });
  return fixed;
}

}  // namespace

void SweepDistances(Band& band, const std::vector<VoxelMask>& crossings,
                    const Execution& execution) {
  std::vector<LineMask> changed, changes(band.size());
  const std::vector<float> fixed = FixCrossings(band, crossings, changed);
  std::vector<float> next = band.distance = fixed;
  const auto is_settled = [](LineMask mask) { return mask == 0; };
  while (!std::all_of(changed.begin(), changed.end(), is_settled) && !execution.IsCancelled()) {
    // A line that is left out has not changed in the last iteration, so `next` holds its values.
    tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
      const BandView view(band, band.distance, b);
      changes[b] = Iterate(view, LinesToUpdate(band, b, changed), fixed.data() + kBlockVoxels * b,
                           next.data() + kBlockVoxels * b);
    });
    std::swap(band.distance, next);
    std::swap(changed, changes);
  }
}

}  // namespace lascaux
